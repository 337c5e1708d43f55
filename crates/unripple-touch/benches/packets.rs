//! What one poll of packets costs, good and hostile, per packet and for a whole poll.

use std::net::SocketAddr;
use std::time::Instant;
use unripple_core::{Outline, Shape};
use unripple_touch::{Heard, Message, Options, OscReceiver};

/// A message of 32-bit arguments after a text, as TUIO 1.1 has them.
fn message(command: &str, tags: &str, values: &[u32]) -> Vec<u8> {
    let mut bytes = b"/tuio/2Dcur\0".to_vec();
    for text in [format!(",s{tags}"), command.to_owned()] {
        bytes.extend(text.as_bytes());
        bytes.push(0);
        bytes.resize(bytes.len().next_multiple_of(4), 0);
    }
    values.iter().for_each(|value| bytes.extend(value.to_be_bytes()));
    bytes
}

fn bundle(elements: &[Vec<u8>]) -> Vec<u8> {
    let mut bytes = b"#bundle\0\0\0\0\0\0\0\0\x01".to_vec();
    for element in elements {
        bytes.extend((element.len() as u32).to_be_bytes());
        bytes.extend(element);
    }
    bytes
}

/// A frame of `count` cursors, all of them moved.
fn frame(count: u32, first: u32, fseq: u32) -> Vec<u8> {
    let ids: Vec<u32> = (first..first + count).collect();
    let tags = "i".repeat(ids.len());
    let place = |id: u32| ((id.wrapping_mul(7919).wrapping_add(fseq) % 1000) as f32 / 1000.0).to_bits();
    let mut elements = vec![message("alive", &tags, &ids)];
    elements
        .extend(ids.iter().map(|id| message("set", "ifffff", &[*id, place(*id), place(id + 1), 0, 0, 0])));
    elements.push(message("fseq", "i", &[fseq]));
    bundle(&elements)
}

fn report(what: &str, limit_us: f64, mut times: Vec<f64>) {
    times.sort_by(f64::total_cmp);
    let at = |share: f64| times[((times.len() - 1) as f64 * share) as usize] * 1e6;
    println!("{what:<44} {:>9.1} {:>9.1} {:>9.1} {limit_us:>9.0}", at(0.5), at(0.99), at(1.0));
}

fn timed(rounds: u32, mut work: impl FnMut(u32)) -> Vec<f64> {
    let mut once = |i| {
        let start = Instant::now();
        work(i);
        start.elapsed().as_secs_f64()
    };
    (0..rounds).map(&mut once).collect()
}

fn main() {
    let sheet = Outline::new(Shape::Rectangle { width: 0.15, height: 0.10 });
    let from = SocketAddr::from(([127, 0, 0, 1], 5000));
    println!("{:<44} {:>9} {:>9} {:>9} {:>9}", "us", "median", "p99", "worst", "limit");
    let run = |what: &str, limit: f64, rounds: u32, packets: &dyn Fn(u32) -> Vec<Vec<u8>>| {
        let mut receiver = OscReceiver::new(Options::new(&sheet)).expect("the options are sound");
        let mut heard = Heard::default();
        let all: Vec<Vec<Vec<u8>>> = (0..rounds).map(packets).collect();
        let times = timed(rounds, |i| {
            heard.clear();
            receiver.begin(f64::from(i) * 0.01);
            all[i as usize].iter().for_each(|packet| receiver.packet(from, packet, &mut heard));
            receiver.end(&mut heard);
        });
        report(what, limit, times);
    };
    run("a frame of 10 cursors", 50.0, 20_000, &|i| vec![frame(10, 0, i)]);
    run("a frame of 100 cursors, 84 too many", 500.0, 5000, &|i| vec![frame(100, 0, i)]);
    run("16 kB of cursors never seen before", 1000.0, 2000, &|i| vec![frame(240, i * 240, i)]);
    run("the fullest poll: 5 such packets", 5e3, 500, &|i| {
        (0..5).map(|k| frame(240, (5 * i + k) * 240, 5 * i + k)).collect()
    });
    let alive = |i: u32| bundle(&[message("alive", &"i".repeat(3000), &(i..i + 3000).collect::<Vec<_>>())]);
    run("a list of 3000 cursors alive", 1000.0, 2000, &|i| vec![alive(i)]);
    let tiny = bundle(&vec![b"/a\0\0,\0\0\0".to_vec(); 1300]);
    run("1300 empty messages", 1000.0, 2000, &|_| vec![tiny.clone()]);
    let text = r#"{"v":1,"type":"touch","finger":1,"phase":"move","at_mm":[62.25,90.5],"force_n":0.3}"#;
    report("a message of the WebSocket", 50.0, timed(20_000, |_| assert!(Message::read(text).is_ok())));
    let nested = format!("{{\"v\":1,\"type\":{}", "[".repeat(4000));
    report("4 kB of nested brackets there", 100.0, timed(5000, |_| assert!(Message::read(&nested).is_err())));
}
