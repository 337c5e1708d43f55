//! Virtual surfaces, sound servers and files as one kind of device.
