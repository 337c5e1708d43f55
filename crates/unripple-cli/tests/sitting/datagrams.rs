//! Datagrams of OSC: touches under the program's own addresses and of TUIO, and such as mean nothing.

use unripple_core::Random;

/// Address of TUIO 1.1 for fingers on a plane.
const CURSORS: &str = "/tuio/2Dcur";

/// A text as OSC writes it: ended by a zero, in whole words of four bytes.
fn padded(text: &str) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    bytes.resize(text.len() / 4 * 4 + 4, 0);
    bytes
}

/// A message with the types of its arguments and these in words of four bytes.
fn message(address: &str, types: &str, arguments: &[[u8; 4]]) -> Vec<u8> {
    [padded(address), padded(types), arguments.concat()].concat()
}

/// A finger at a place in mm.
pub fn touch(finger: i32, at_mm: [f64; 2]) -> Vec<u8> {
    let [x, y] = at_mm.map(|mm| (mm as f32).to_be_bytes());
    message("/unripple/touch", ",iff", &[finger.to_be_bytes(), x, y])
}

/// A finger that is lifted.
pub fn lift(finger: i32) -> Vec<u8> {
    message("/unripple/lift", ",i", &[finger.to_be_bytes()])
}

/// A frame of TUIO 1.1: cursors at places of the sensor, from 0 to 1.
pub fn cursors(frame: i32, places: &[[f64; 2]]) -> Vec<u8> {
    let mut alive = vec![*b"aliv", *b"e\0\0\0"];
    alive.extend((0..places.len() as i32).map(i32::to_be_bytes));
    let types = format!(",s{}", "i".repeat(places.len()));
    let mut messages = vec![message(CURSORS, &types, &alive)];
    for (id, [x, y]) in (0i32..).zip(places) {
        let mut set = vec![*b"set\0", id.to_be_bytes()];
        set.extend([*x, *y, 0.0, 0.0, 0.0].map(|number| (number as f32).to_be_bytes()));
        messages.push(message(CURSORS, ",sifffff", &set));
    }
    messages.push(message(CURSORS, ",si", &[*b"fseq", [0; 4], frame.to_be_bytes()]));
    // To be taken at once.
    let mut bundle = [padded("#bundle"), vec![0, 0, 0, 0, 0, 0, 0, 1]].concat();
    for message in messages {
        bundle.extend((message.len() as u32).to_be_bytes());
        bundle.extend(message);
    }
    bundle
}

/// Bytes at random, or a touch with some of its bytes replaced, cut short.
pub fn garbage(random: &mut Random) -> Vec<u8> {
    let length = random.between(0.0, 400.0) as usize;
    if random.uniform() < 0.5 {
        return (0..length).map(|_| byte(random)).collect();
    }
    let mut bytes = if random.uniform() < 0.5 { touch(50, [62.0, 90.0]) } else { cursors(7, &[[0.4, 0.6]]) };
    for _ in 0..3 {
        let at = random.between(0.0, bytes.len() as f64) as usize % bytes.len();
        bytes[at] = byte(random);
    }
    bytes.truncate(length);
    bytes
}

fn byte(random: &mut Random) -> u8 {
    random.between(0.0, 256.0) as u8
}
