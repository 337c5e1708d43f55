//! Archives and arrays of numpy, made byte by byte.

use miniz_oxide::deflate::compress_to_vec;

/// An array of numpy: type, whether the first axis runs fastest, shape as Python writes it, and values.
pub fn npy(descr: &str, first_fastest: bool, shape: &str, values: &[u8]) -> Vec<u8> {
    let order = if first_fastest { "True" } else { "False" };
    let mut header =
        format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}").into_bytes();
    while (10 + header.len()) % 64 != 63 {
        header.push(b' ');
    }
    header.push(b'\n');
    let length = (header.len() as u16).to_le_bytes();
    [&b"\x93NUMPY\x01\x00"[..], &length, &header, values].concat()
}

/// Checksum of a member, bit by bit.
fn crc(bytes: &[u8]) -> u32 {
    let mut check = u32::MAX;
    for byte in bytes {
        check ^= u32::from(*byte);
        for _ in 0..8 {
            check = if check & 1 == 1 { (check >> 1) ^ 0xedb8_8320 } else { check >> 1 };
        }
    }
    !check
}

/// An archive with these members, deflated or stored.
pub fn zip(members: &[(&str, Vec<u8>)], deflated: bool) -> Vec<u8> {
    let (mut out, mut directory) = (Vec::new(), Vec::new());
    for (name, bytes) in members {
        let packed = if deflated { compress_to_vec(bytes, 6) } else { bytes.clone() };
        let method: u16 = if deflated { 8 } else { 0 };
        let mut fields = Vec::new();
        fields.extend(20_u16.to_le_bytes());
        fields.extend(0_u16.to_le_bytes());
        fields.extend(method.to_le_bytes());
        fields.extend([0; 4]);
        fields.extend(crc(bytes).to_le_bytes());
        fields.extend((packed.len() as u32).to_le_bytes());
        fields.extend((bytes.len() as u32).to_le_bytes());
        fields.extend((name.len() as u16).to_le_bytes());
        fields.extend(0_u16.to_le_bytes());
        let offset = out.len() as u32;
        out.extend([&b"PK\x03\x04"[..], &fields, name.as_bytes(), &packed].concat());
        directory.extend(
            [&b"PK\x01\x02\x14\x00"[..], &fields, &[0; 10], &offset.to_le_bytes(), name.as_bytes()].concat(),
        );
    }
    let at = out.len() as u32;
    let (count, size) = ((members.len() as u16).to_le_bytes(), (directory.len() as u32).to_le_bytes());
    out.extend(&directory);
    out.extend(
        [&b"PK\x05\x06\x00\x00\x00\x00"[..], &count, &count, &size, &at.to_le_bytes(), &[0; 2]].concat(),
    );
    out
}
