// The way to the session: that of a server, or where the page was published without one, a session in this page.
//
// Both have the same parts: `connect()` gives a socket like a WebSocket that is being opened; `ask(path, options)` does what fetch() does
// with a file of the session; `address(path)` is where a link to such a file leads; `silence_ms` is how long a socket may say nothing,
// `connected` what the page says of one that is open.

import { Here } from './line-here.js';
import { Server } from './line-server.js';

/** The way that this page was made for. */
export const line = document.documentElement.dataset.session === 'here' ? new Here() : new Server();
