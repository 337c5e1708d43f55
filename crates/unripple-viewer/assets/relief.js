// The surface as a lit height field. Heights are exaggerated, and the text below says how much.

import { divergingBytes } from './colours.js';
import { watchPixels } from './map.js';
import { Orbit } from './orbit.js';
import { ReliefNames } from './relief-names.js';
import { makePrograms } from './shaders.js';
import { metres, number, speed } from './units.js';

const LIFT = 0.13;
const MASK = 512;
// Nodes along a side of the mesh, finest first; a slow machine goes down these steps and stays there.
const NODES = [193, 129, 97, 65, 49];
const SLOW_MS = 60;
const TIMED_EVERY = 4;
const TIMED = 3;
const TINTS = {
  dark: { edge: [0.85, 0.9, 0.95, 0.8], drive: [0.31, 0.81, 0.61, 1], finger: [1, 0.82, 0.4, 1], target: [1, 1, 1, 0.7] },
  light: { edge: [0.1, 0.13, 0.16, 0.8], drive: [0, 0.41, 0.3, 1], finger: [0.48, 0.16, 0.55, 1], target: [0, 0, 0, 0.7] },
};

/** One pane's relief, made only when it is first shown. */
export class Relief {
  #gl;
  #programs = null;
  #sheet = null;
  #made = null;
  #theme = null;
  #size = null;
  #lines = [];
  #painted = 0;
  #times = [];

  constructor(canvas, pane, scene) {
    this.canvas = canvas;
    this.pane = pane;
    this.scene = scene;
    this.note = canvas.parentElement.querySelector('.relief-note');
    this.names = new ReliefNames(canvas);
    this.orbit = new Orbit(canvas, scene.app.state, () => scene.redraw());
    watchPixels(canvas, (width, height) => {
      canvas.width = width;
      canvas.height = height;
      this.#size = [width, height];
      this.paint();
    });
    canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      this.#programs = null;
    });
    canvas.addEventListener('webglcontextrestored', () => {
      this.#start();
      scene.redraw();
    });
  }

  setSheet(sheet) {
    this.#sheet = sheet;
    this.#drop();
  }

  show(on) {
    this.canvas.hidden = !on;
    this.note.hidden = !on;
    this.names.show(on);
  }

  /** The graphics context, asked for once. */
  #context() {
    if (this.#gl === undefined) {
      this.#gl = this.canvas.getContext('webgl2', { antialias: true, alpha: false });
      if (this.#gl) this.#start();
      else this.note.textContent = 'This browser shows no WebGL 2, so there is no relief. The map shows the same field.';
    }
    return this.#gl;
  }

  #start() {
    try {
      this.#programs = makePrograms(this.#gl);
      // What a lost context held is gone with it.
      this.#made = null;
      this.#theme = null;
    } catch (error) {
      this.#programs = null;
      this.note.textContent = 'The graphics driver refused the relief. The map shows the same field.';
      console.error(error);
    }
  }

  paint() {
    const gl = this.#context();
    const frame = this.scene.frame(this.pane);
    if (!gl || !this.#programs || !this.#size) return;
    const started = performance.now();
    const [width, height] = this.#size;
    gl.viewport(0, 0, width, height);
    const ground = this.scene.ground.match(/\w\w/g).map((h) => parseInt(h, 16) / 255);
    gl.clearColor(...ground, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    if (!frame || !this.#sheet) return;
    this.#make(frame);
    this.#upload(frame);
    const camera = this.orbit.matrix(width, height);
    gl.enable(gl.DEPTH_TEST);
    this.#drawField(frame, camera);
    this.#drawLines(frame, camera, width, height);
    this.names.follow(camera);
    this.#tell(frame);
    this.#watch(started);
  }

  /** Nodes along a side of the mesh, kept for this tab of the browser. */
  get nodes() {
    const kept = this.scene.app.state.ui.relief_nodes;
    return NODES.includes(kept) ? kept : NODES[0];
  }

  /** Times a picture now and then, until the graphics driver is through with it. */
  #watch(started) {
    this.#painted += 1;
    if (this.#painted % TIMED_EVERY !== 0) return;
    const gl = this.#gl;
    const sync = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    const look = () => {
      if (!sync || gl.isContextLost()) return;
      if (gl.getSyncParameter(sync, gl.SYNC_STATUS) !== gl.SIGNALED) {
        setTimeout(look, 4);
        return;
      }
      gl.deleteSync(sync);
      if (!document.hidden) this.#timed(performance.now() - started);
    };
    setTimeout(look, 0);
  }

  /** Takes a coarser mesh where pictures come too slowly. */
  #timed(ms) {
    this.#times.push(ms);
    if (this.#times.length < TIMED) return;
    const mean = this.#times.reduce((sum, each) => sum + each, 0) / this.#times.length;
    this.#times = [];
    if (!this.#made) return;
    const coarser = NODES.find((nodes) => nodes < Math.max(...this.#made.fine));
    if (mean > SLOW_MS && coarser) this.scene.app.state.ui.relief_nodes = coarser;
  }

  #drop() {
    const gl = this.#gl;
    if (!gl || !this.#made) return;
    const { index, buffer, heights, colours, mask } = this.#made;
    for (const one of [index, buffer]) gl.deleteBuffer(one);
    for (const one of [heights, colours, mask]) gl.deleteTexture(one);
    this.#made = null;
  }

  /** Textures and buffers that depend on the surface and the size of the grid. */
  #make(frame) {
    const gl = this.#gl;
    const { columns, rows } = frame;
    const { nodes } = this;
    if (this.#made?.columns === columns && this.#made.rows === rows && this.#made.nodes === nodes) return;
    this.#drop();
    const most = Math.max(this.#sheet.width, this.#sheet.height);
    const unit = ([x, y]) => [(x - this.#sheet.width / 2) / most, (y - this.#sheet.height / 2) / most];
    const [left, bottom, width, height] = this.#sheet.cover();
    const fine = [columns, rows].map((count) => Math.min(count + 1, nodes));
    const index = [];
    for (let r = 0; r + 1 < fine[1]; r += 1) {
      for (let c = 0; c + 1 < fine[0]; c += 1) {
        const a = r * fine[0] + c;
        index.push(a, a + 1, a + fine[0], a + 1, a + fine[0] + 1, a + fine[0]);
      }
    }
    const made = { columns, rows, nodes, fine, unit, most, count: index.length, cells: new Int16Array(columns * rows) };
    made.cover = [...unit([left, bottom]), width / most, height / most];
    made.index = gl.createBuffer();
    gl.bindVertexArray(null);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, made.index);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, Uint32Array.from(index), gl.STATIC_DRAW);
    made.heights = gl.createTexture();
    made.colours = gl.createTexture();
    made.mask = gl.createTexture();
    made.buffer = gl.createBuffer();
    this.#made = made;
    this.#theme = null;
    this.#makeMask();
    this.names.set(this.#sheet.actuators, unit);
  }

  #texture(unit, texture, filter) {
    const gl = this.#gl;
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, filter);
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
  }

  #makeMask() {
    const gl = this.#gl;
    const canvas = document.createElement('canvas');
    canvas.width = MASK;
    canvas.height = MASK;
    const ctx = canvas.getContext('2d');
    const [left, bottom, width, height] = this.#sheet.cover();
    ctx.setTransform(MASK / width, 0, 0, MASK / height, (-left * MASK) / width, (-bottom * MASK) / height);
    ctx.fillStyle = '#fff';
    ctx.fill(this.#sheet.path, 'evenodd');
    this.#texture(2, this.#made.mask, gl.LINEAR);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    const bytes = ctx.getImageData(0, 0, MASK, MASK).data;
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, MASK, MASK, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(bytes.buffer));
  }

  #upload(frame) {
    const gl = this.#gl;
    const { cells, heights, colours } = this.#made;
    const pairs = this.#sheet.fits(frame) ? this.#sheet.pairs : [];
    cells.set(frame.values);
    for (let i = 0; i < pairs.length; i += 2) cells[pairs[i]] = cells[pairs[i + 1]];
    this.#texture(0, heights, gl.NEAREST);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.R16I, frame.columns, frame.rows, 0, gl.RED_INTEGER, gl.SHORT, cells);
    if (this.#theme === this.scene.theme) return;
    this.#theme = this.scene.theme;
    const bytes = divergingBytes(this.#theme);
    this.#texture(1, colours, gl.LINEAR);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, bytes.length / 4, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  }

  #drawField(frame, camera) {
    const gl = this.#gl;
    const { program, at } = this.#programs.field;
    const made = this.#made;
    gl.useProgram(program);
    gl.bindVertexArray(null);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, made.index);
    gl.uniform1i(at.heights, 0);
    gl.uniform1i(at.colours, 1);
    gl.uniform1i(at.mask, 2);
    gl.uniform2i(at.cells, made.columns, made.rows);
    gl.uniform2i(at.fine, ...made.fine);
    gl.uniform4f(at.cover, ...made.cover);
    gl.uniform1f(at.share, frame.head.scale / this.scene.full);
    gl.uniform1f(at.lift, LIFT);
    gl.uniform1f(at.body, this.scene.theme === 'dark' ? 0.28 : 0.08);
    const { turn } = this.orbit;
    const light = [-0.55, 0.45, 0.7].map((c, i, l) => c / Math.hypot(...l));
    const [c, s] = [Math.cos(turn), Math.sin(turn)];
    gl.uniform3f(at.light, c * light[0] - s * light[1], s * light[0] + c * light[1], light[2]);
    gl.uniformMatrix4fv(at.camera, false, camera);
    gl.drawElements(gl.TRIANGLES, made.count, gl.UNSIGNED_INT, 0);
  }

  #line(from, to, tint) {
    for (const [end, side] of [[0, -1], [0, 1], [1, -1], [0, 1], [1, -1], [1, 1]]) {
      // The side is seen along the line, the same for both ends.
      this.#lines.push(...from, ...to, end, side, ...tint);
    }
  }

  #ring(centre, radius, z, tint) {
    const count = 40;
    const at = (i) => {
      const angle = (2 * Math.PI * i) / count;
      return [centre[0] + radius * Math.cos(angle), centre[1] + radius * Math.sin(angle), z];
    };
    for (let i = 0; i < count; i += 1) this.#line(at(i), at(i + 1), tint);
  }

  #drawLines(frame, camera, width, height) {
    const gl = this.#gl;
    const { unit, most, buffer } = this.#made;
    const tints = TINTS[this.scene.theme] ?? TINTS.dark;
    this.#lines = [];
    for (const ring of this.#sheet.rings) {
      ring.forEach((mm, i) => this.#line([...unit(mm), 0], [...unit(ring[(i + 1) % ring.length]), 0], tints.edge));
    }
    this.#sheet.actuators.forEach(({ at_mm }, i) => {
      const [x, y] = unit(at_mm);
      const drive = frame.head.drive?.[i] ?? 0;
      this.#ring([x, y], 0.012, 0, tints.edge);
      const lit = this.scene.driven > 0 ? Math.max(-1, Math.min(1, drive / this.scene.driven)) : 0;
      if (Math.abs(lit) > 0.02) this.#line([x, y, 0], [x, y, 0.12 * lit], tints.drive);
    });
    for (const at of frame.head.targets ?? []) this.#ring(unit(at), this.#sheet.focalRadius / most, 0.002, tints.target);
    for (const finger of frame.head.fingers ?? []) {
      this.#ring(unit(finger.at_mm), this.scene.reach(finger) / most, 0.004, tints.finger);
    }
    const { program, at } = this.#programs.line;
    gl.useProgram(program);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, Float32Array.from(this.#lines), gl.DYNAMIC_DRAW);
    const stride = 12 * 4;
    for (const [i, size, offset] of [[0, 3, 0], [1, 3, 12], [2, 2, 24], [3, 4, 32]]) {
      gl.enableVertexAttribArray(i);
      gl.vertexAttribPointer(i, size, gl.FLOAT, false, stride, offset);
    }
    gl.uniformMatrix4fv(at.camera, false, camera);
    gl.uniform2f(at.size, width, height);
    gl.uniform1f(at.width, 1.6 * this.scene.line * (devicePixelRatio || 1));
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.drawArrays(gl.TRIANGLES, 0, this.#lines.length / 12);
    gl.disable(gl.BLEND);
    for (let i = 0; i < 4; i += 1) gl.disableVertexAttribArray(i);
  }

  #tell(frame) {
    const full = this.scene.full;
    const height = LIFT * this.#made.most * 1e-3;
    const text = frame.head.quantity === 'velocity'
      ? `${speed(full)} drawn ${metres(height)} high`
      : `Heights × ${number(height / full, 2)}: ${metres(full)} drawn ${metres(height)} high`;
    if (this.note.textContent !== text) this.note.textContent = text;
  }
}
