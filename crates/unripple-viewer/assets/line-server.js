// The way to the session of the server that this page came from.

const words = new URLSearchParams(location.search).get('token');

/** A WebSocket, and files by HTTP. */
export class Server {
  silence_ms = 3000;
  connected = 'Connected';

  /** An address of this server with the page's token. */
  address(path) {
    if (!words) return path;
    return `${path}${path.includes('?') ? '&' : '?'}token=${encodeURIComponent(words)}`;
  }

  ask(path, options) {
    return fetch(this.address(path), options);
  }

  connect() {
    const scheme = location.protocol === 'https:' ? 'wss:' : 'ws:';
    const socket = new WebSocket(this.address(`${scheme}//${location.host}/link`));
    socket.binaryType = 'arraybuffer';
    return socket;
  }
}
