// Binary frames: length of a JSON head, the head, cells as 16-bit counts, then traces of as many samples each.

const text = new TextDecoder();
const MOST_CELLS = 1 << 22;

/** Reads a frame; throws an Error that says what was expected and what was found. */
export function parseFrame(buffer) {
  if (buffer.byteLength < 4) throw new Error(`a frame needs 4 bytes at least, found ${buffer.byteLength}`);
  const length = new DataView(buffer).getUint32(0, true);
  if (length % 4 !== 0 || 4 + length > buffer.byteLength) {
    throw new Error(`a frame of ${buffer.byteLength} bytes cannot have a head of ${length}`);
  }
  const head = JSON.parse(text.decode(new Uint8Array(buffer, 4, length)));
  const { columns, rows, samples = 0 } = head;
  const cells = columns * rows;
  const traces = head.traces ?? [];
  if (!(columns > 1 && rows > 1 && cells <= MOST_CELLS)) throw new Error(`a frame of ${columns} by ${rows} cells`);
  const needed = 4 + length + 2 * (cells + traces.length * samples);
  if (needed !== buffer.byteLength) throw new Error(`a frame of ${needed} bytes was announced, found ${buffer.byteLength}`);
  const values = new Int16Array(buffer, 4 + length, cells);
  let at = 4 + length + 2 * cells;
  const read = traces.map((trace) => {
    const part = new Int16Array(buffer, at, samples);
    at += 2 * samples;
    return { ...trace, samples: part };
  });
  return { head, pane: head.pane ?? 0, panes: head.panes ?? 1, columns, rows, values, traces: read };
}
