//! OSC packets read from bytes.

use rosc::{OscMessage, OscPacket, decoder};
use std::ops::Range;

/// The longest packet that is read, in bytes: a frame of a hundred fingers is half of it.
pub(super) const LONGEST: usize = 16 * 1024;
/// How deep bundles may lie in bundles: trackers use one level, and each costs a call.
const DEEPEST: usize = 4;
/// The first bytes of an OSC bundle, and the length of those and its time tag.
const BUNDLE: &[u8] = b"#bundle\0";
const BUNDLE_HEAD: usize = 16;

/// Finds the messages of a packet, in order; false if its sizes do not fit together.
///
/// The decoder of messages is never given a bundle: it recurses as deep as bundles lie in bundles, and stops
/// silently at the first element that is wrong.
pub(super) fn split(packet: &[u8], messages: &mut Vec<Range<usize>>) -> bool {
    messages.clear();
    packet.len() <= LONGEST && element(packet, 0..packet.len(), 0, messages)
}

fn element(packet: &[u8], range: Range<usize>, depth: usize, messages: &mut Vec<Range<usize>>) -> bool {
    let bytes = &packet[range.clone()];
    if !bytes.len().is_multiple_of(4) {
        return false;
    }
    if !bytes.starts_with(BUNDLE) {
        messages.push(range);
        return bytes.first() == Some(&b'/');
    }
    if depth == DEEPEST || bytes.len() < BUNDLE_HEAD {
        return false;
    }
    let mut rest = &bytes[BUNDLE_HEAD..];
    while let Some((size, after)) = rest.split_first_chunk::<4>() {
        let size = u32::from_be_bytes(*size) as usize;
        let start = range.end - after.len();
        if size > after.len() || !element(packet, start..start + size, depth + 1, messages) {
            return false;
        }
        rest = &after[size..];
    }
    rest.is_empty()
}

/// Decodes one message; nothing if it is not one, or holds arrays.
///
/// Arrays are refused here, since nested ones are freed by recursion, as deep as the packet is long.
pub(super) fn message(bytes: &[u8]) -> Option<OscMessage> {
    let address = bytes.iter().position(|byte| *byte == 0)?;
    let tags = bytes.get((address / 4 + 1) * 4..)?;
    if tags.first() != Some(&b',') || tags.iter().take_while(|byte| **byte != 0).any(|byte| *byte == b'[') {
        return None;
    }
    match decoder::decode_udp(bytes) {
        Ok(([], OscPacket::Message(message))) => Some(message),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn bundle(elements: &[Vec<u8>]) -> Vec<u8> {
        let mut bytes = b"#bundle\0\0\0\0\0\0\0\0\x01".to_vec();
        for element in elements {
            bytes.extend((element.len() as u32).to_be_bytes());
            bytes.extend(element);
        }
        bytes
    }

    #[test]
    fn finds_messages_in_order_at_any_legal_depth() {
        let message = |name: &[u8]| [name, b",\0\0\0"].concat();
        let (a, b, c) = (message(b"/a\0\0"), message(b"/b\0\0"), message(b"/c\0\0"));
        let packet = bundle(&[a.clone(), bundle(&[bundle(&[]), b.clone()]), c.clone()]);
        let mut ranges = Vec::new();
        assert!(split(&packet, &mut ranges));
        let found: Vec<&[u8]> = ranges.iter().map(|range| &packet[range.clone()]).collect();
        assert_eq!(found, [&a[..], &b, &c]);
        let mut deep = a;
        for depth in 1..=DEEPEST + 1 {
            deep = bundle(&[deep]);
            assert_eq!(split(&deep, &mut ranges), depth <= DEEPEST);
        }
    }

    #[test]
    fn refuses_sizes_that_do_not_fit() {
        let mut ranges = Vec::new();
        let good = bundle(&[b"/a\0\0,i\0\0\0\0\0\x05".to_vec()]);
        assert!(split(&good, &mut ranges));
        for length in 1..good.len() {
            assert!(!split(&good[..length], &mut ranges) || length == BUNDLE_HEAD, "{length}");
        }
        assert!(!split(&[], &mut ranges));
        assert!(!split(&vec![b'/'; LONGEST + 4], &mut ranges));
        let mut huge = good.clone();
        huge[16..20].copy_from_slice(&u32::MAX.to_be_bytes());
        assert!(!split(&huge, &mut ranges));
    }

    #[test]
    fn refuses_nested_arrays_before_they_are_built() {
        let count = LONGEST / 2 - 8;
        let mut bytes = b"/a\0\0,".to_vec();
        bytes.extend(vec![b'['; count / 2]);
        bytes.extend(vec![b']'; count / 2]);
        bytes.resize(bytes.len().next_multiple_of(4) + 4, 0);
        assert_eq!(message(&bytes), None);
        assert!(message(b"/a\0\0,i\0\0\0\0\0\x05").is_some());
        assert_eq!(message(b"/a\0\0,i\0\0\0\0\0"), None);
        assert_eq!(message(b"/a\0\0i\0\0\0\0\0\0\x05"), None);
    }

    proptest! {
        #[test]
        fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..200), head in 0..4usize) {
            let head: &[u8] = [&b""[..], b"/tuio/2Dcur\0,", b"#bundle\0", b"/a\0\0,sfb"][head];
            let packet = [head, &bytes].concat();
            let mut ranges = Vec::new();
            if split(&packet, &mut ranges) {
                for range in ranges {
                    let _ = message(&packet[range]);
                }
            }
            let _ = message(&packet);
        }
    }
}
