// Live traces at fingers and probes: the last milliseconds up to the moment shown.

import { Chart } from './chart.js';
import { clear, el } from './dom.js';
import { seriesColour } from './colours.js';
import { fieldUnit, fieldValue, place } from './units.js';
import { Scale } from './scale.js';

/** The chart of traces with a legend; probes are removed from there. */
export function mount(root, app) {
  const canvas = el('canvas', { class: 'plot', hidden: true });
  const legend = el('div', { class: 'legend', hidden: true });
  const none = el('p', { class: 'quiet', text: 'Press the surface or drop a probe (button Probe, or P at the keyboard’s cursor) to see the motion of a place.' });
  root.append(el('h2', { text: 'Motion' }), none, canvas, legend);
  const chart = new Chart(canvas, { x: 'Time', xUnit: 'ms', y: 'Displacement', yUnit: 'µm', label: 'Motion at fingers and probes' });
  const scale = new Scale();
  let known = '';
  const theme = () => document.documentElement.dataset.theme;

  const name = (trace, frame) => {
    const last = trace.samples[trace.samples.length - 1] ?? 0;
    return `${trace.name} ${fieldValue(frame.head.quantity, last * trace.scale)}`;
  };
  const label = (frame) => {
    const key = `${theme()} ${frame.traces.map((t) => t.name).join()}`;
    if (key !== known) {
      known = key;
      clear(legend);
      frame.traces.forEach((trace, i) => {
        const swatch = el('i', { class: 'swatch' });
        swatch.style.background = seriesColour(i, theme());
        const chip = el('span', { class: 'chip', title: place(trace.at_mm) }, swatch, el('span'));
        const probe = /^probe (\d+)$/.exec(trace.name);
        if (probe) {
          chip.append(el('button', {
            type: 'button', 'aria-label': `Remove ${trace.name}`, text: '×',
            on: { click: () => app.link.send({ do: 'probe', remove: Number(probe[1]) }) },
          }));
        }
        legend.append(chip);
      });
    }
    frame.traces.forEach((trace, i) => { legend.children[i].children[1].textContent = name(trace, frame); });
  };

  app.state.subscribe('frame', (frame) => {
    if (frame.pane !== 0 || app.shown() !== 'touch') return;
    const any = frame.traces.length > 0 && frame.head.samples > 1;
    none.hidden = any;
    canvas.hidden = !any;
    legend.hidden = !any;
    if (!any) return;
    const { quantity, span_s, samples } = frame.head;
    let most = 0;
    for (const trace of frame.traces) for (const count of trace.samples) most = Math.max(most, Math.abs(count) * trace.scale);
    scale.take(most, quantity, performance.now());
    const { factor, unit } = fieldUnit(quantity, scale.full);
    chart.axes.y = quantity === 'velocity' ? 'Velocity' : 'Displacement';
    chart.axes.yUnit = unit;
    const x = Float32Array.from({ length: samples }, (_, i) => (1e3 * span_s * (i + 1 - samples)) / samples);
    const series = frame.traces.map((trace) => ({
      name: trace.name, x, y: Float32Array.from(trace.samples, (count) => (count * trace.scale) / factor),
    }));
    const full = scale.full / factor;
    chart.draw({ series, xRange: [-1e3 * span_s, 0], yRange: [-full, full] });
    label(frame);
  });
}
