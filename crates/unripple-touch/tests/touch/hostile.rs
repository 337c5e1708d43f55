//! A thousand hostile packets a second over real sockets, and good fingers between them.

use crate::websocket::Client;
use crate::wire::{Arg, bundle, cursors, message};
use crate::{Promise, options, sheet};
use serde_json::json;
use std::net::{SocketAddr, UdpSocket};
use std::time::{Duration, Instant};
use unripple_core::{Phase, Random};
use unripple_touch::{Heard, OscPort, Source, WebSocketOptions, WebSocketPort};

/// How long it goes on, in s, and packets per s.
const SECONDS: f64 = 2.0;
const RATE: f64 = 1000.0;

/// A packet that does not wish well.
fn packet(random: &mut Random, i: i32) -> Vec<u8> {
    let mut below = |n: usize| (random.uniform() * n as f64) as usize;
    let id = below(1 << 30) as i32;
    let crowd: Vec<i32> = (0..150).map(|k| id.wrapping_add(k)).collect();
    let sets: Vec<(i32, f32, f32)> = crowd.iter().map(|id| (*id, 0.5, 0.5)).collect();
    match below(10) {
        0 => (0..below(600)).map(|_| below(256) as u8).collect(),
        1 => {
            let whole = cursors("good", &[1], &[(1, 0.9, 0.9)], 1);
            whole[..below(whole.len())].to_vec()
        }
        2 => cursors("good", &crowd, &sets, i),
        3 => cursors(&format!("name {id}"), &[1], &[(1, f32::NAN, 0.5)], i),
        4 => cursors("late", &[1], &[(1, 0.5, f32::INFINITY)], below(100) as i32),
        5 => (0..20).fold(message("/a", &[]), |inner, _| bundle(&[inner])),
        6 => vec![0xff; below(60_000)],
        7 => [b"/a\0\0,".to_vec(), vec![b'['; 4096], vec![b']'; 4095], vec![0; 4]].concat(),
        8 => message("/unripple/touch", &[Arg::I(id), Arg::F(f32::NAN), Arg::F(1e30)]),
        _ => bundle(&vec![message("/unripple/effect", &[Arg::S("flood")]); 200]),
    }
}

/// What a client that does not wish well says.
fn text(random: &mut Random) -> Vec<u8> {
    let mut below = |n: usize| (random.uniform() * n as f64) as usize;
    match below(5) {
        0 => vec![b'['; 3000],
        1 => (0..below(300)).map(|_| 32 + below(95) as u8).collect(),
        2 => br#"{"v":1,"type":"touch","finger":1,"phase":"down","at_mm":[1e308,-1e308]}"#.to_vec(),
        3 => {
            format!(r#"{{"v":1,"type":"touch","finger":{},"phase":"down","at_mm":[75,50]}}"#, below(1 << 30))
                .into()
        }
        _ => br#"{"v":1,"type":"effect","name":"flood"}"#.to_vec(),
    }
}

struct Attack {
    random: Random,
    sockets: Vec<UdpSocket>,
    clients: Vec<Client>,
    fresh: Option<Client>,
    sent: usize,
    to: SocketAddr,
}

impl Attack {
    fn go_on(&mut self, web: &WebSocketPort, elapsed: f64) {
        while (self.sent as f64) < elapsed * RATE {
            self.sent += 1;
            if !self.sent.is_multiple_of(4) {
                let packet = packet(&mut self.random, self.sent as i32);
                let _ = self.sockets[self.sent % 3].send_to(&packet, self.to);
                continue;
            }
            // A client that was thrown out comes again.
            if self.sent.is_multiple_of(100) {
                let mut client = Client::new(web);
                client.request(&[]);
                // It is used when its request has been answered.
                self.clients.extend(self.fresh.replace(client));
                self.clients.drain(..self.clients.len().saturating_sub(3));
            }
            if self.clients.is_empty() {
                continue;
            }
            let words = text(&mut self.random);
            let client = self.sent % self.clients.len();
            self.clients[client].frame(if self.sent.is_multiple_of(60) { 0xf3 } else { 0x81 }, &words);
        }
    }
}

#[test]
fn good_fingers_pass_between_a_thousand_hostile_packets_a_second() {
    let mut osc = OscPort::local(0, options()).unwrap();
    let mut web = WebSocketPort::local(0, options(), WebSocketOptions::default()).unwrap();
    let udp = || UdpSocket::bind("127.0.0.1:0").unwrap();
    let (tracker, mut page) = (udp(), Client::new(&web));
    page.request(&[]);
    let sockets = (0..3).map(|_| udp()).collect();
    let (random, clients, to) = (Random::seeded(11), Vec::new(), osc.address());
    let mut attack = Attack { random, sockets, clients, fresh: None, sent: 0, to };
    let (mut promises, mut good, mut told, mut last) =
        ([Promise::default(), Promise::default()], [0, 0], 0, 0.0);
    let (mut most, mut longest) = ([0, 0], 0);
    let start = Instant::now();
    loop {
        let now = start.elapsed().as_secs_f64();
        if now > SECONDS {
            break;
        }
        attack.go_on(&web, now);
        // A hundred times a second a good finger moves, on x = 30 mm by TUIO, on x = 120 mm by WebSocket: only when those who do not wish
        // well have long taken all the places that there are, as they may on a machine that stands still for a moment.
        if now > 0.3 && now - last > 0.01 {
            (told, last) = (told + 1, now);
            let y = 0.2 + 0.6 * ((told % 100) as f32 / 100.0);
            tracker.send_to(&cursors("good", &[1], &[(1, 0.2, y)], told), to).unwrap();
            let phase = if told == 1 { "down" } else { "move" };
            page.say(&json!({"v":1,"type":"touch","finger":1,"phase":phase,"at_mm":[120.0, 100.0 * y]}));
        }
        let sources: [&mut dyn Source; 2] = [&mut osc, &mut web];
        for (i, source) in sources.into_iter().enumerate() {
            let mut heard = Heard::default();
            source.poll(now, &mut heard);
            promises[i].hold(&heard.touches, &sheet());
            let x = [0.03, 0.12][i];
            let ours = |t: &&unripple_core::Touch| (t.at.x - x).abs() < 1e-6 && t.phase != Phase::Up;
            good[i] += heard.touches.iter().filter(ours).count();
            longest = longest.max(heard.touches.len() + heard.wishes.len());
        }
        most = [most[0].max(osc.tracked()), most[1].max(web.tracked())];
        std::thread::sleep(Duration::from_millis(1));
    }
    let (by_udp, by_web) = (osc.counts(), web.counts());
    println!("sent {} hostile; good {good:?} of {told}; {by_udp:?}; {by_web:?}", attack.sent);
    // What the clock of a busy machine leaves out is not the decoder's: most of the good ones came through.
    assert!(good.iter().all(|n| *n as i32 > told / 2), "{good:?} of {told}");
    for kind in
        [by_udp.malformed, by_udp.numbers, by_udp.late, by_udp.crowded, by_web.malformed, by_web.outside]
    {
        assert!(kind > 0, "{by_udp:?} {by_web:?}");
    }
    // 32 fingers, 16 senders of 4 names and themselves; 32 fingers, 16 connections.
    assert!(most[0] <= 32 + 16 * 5 && most[1] <= 32 + 16, "{most:?}");
    assert!(longest <= 32 + 2 * 256 + 32 + 64, "{longest}");
}
