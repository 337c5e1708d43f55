// A picture of what is seen, with its colour bar and a caption; and the files that belong to it.

import { drawBar } from './bar.js';
import { el, save } from './dom.js';

/** The panes, bar and caption on one canvas. */
export function compose(stage) {
  stage.paintNow();
  const shown = stage.maps.slice(0, stage.panes).map((map, i) => (stage.view === 'relief' ? stage.reliefs[i].canvas : map.canvas));
  const ratio = shown[0].width / Math.max(1, shown[0].clientWidth);
  const font = Math.round(14 * ratio);
  const width = shown.reduce((sum, canvas) => sum + canvas.width, 0);
  const height = Math.max(...shown.map((canvas) => canvas.height));
  const strip = Math.round(font * 5.2);
  const out = document.createElement('canvas');
  out.width = width;
  out.height = height + strip;
  const ctx = out.getContext('2d');
  ctx.fillStyle = stage.ground;
  ctx.fillRect(0, 0, out.width, out.height);
  let left = 0;
  ctx.font = `${font}px system-ui, sans-serif`;
  shown.forEach((canvas, i) => {
    ctx.drawImage(canvas, left, 0);
    ctx.fillStyle = stage.inkColour;
    ctx.textBaseline = 'top';
    if (stage.panes > 1) ctx.fillText(stage.figures[i].querySelector('.pane-label b')?.textContent ?? '', left + font, font / 2);
    left += canvas.width;
  });
  ctx.save();
  ctx.translate(0, height + font * 0.4);
  const { full, quantity, theme, inkColour } = stage;
  drawBar(ctx, width, font * 2.6, { full, quantity, theme, ink: inkColour, font: font * 0.9 });
  ctx.restore();
  ctx.fillStyle = stage.inkColour;
  ctx.textAlign = 'left';
  ctx.textBaseline = 'bottom';
  ctx.font = `${font}px system-ui, sans-serif`;
  const note = stage.view === 'relief' ? `. ${stage.reliefs[0].note.textContent}` : '';
  ctx.fillText(`${stage.caption()}${note}`, font, out.height - font * 0.5, width - 2 * font);
  return out;
}

/** The picture's button and the links to files. */
export function mount(root, app, stage) {
  document.getElementById('export-png').addEventListener('click', () => {
    if (!stage.frame(0)) {
      app.toast('There is no picture yet.');
      return;
    }
    const name = `${(app.state.last('surface')?.name ?? 'surface').replace(/[^\w-]+/g, '-')}.png`;
    compose(stage).toBlob((blob) => {
      if (blob) save(blob, name);
      else app.toast('The browser could not make the picture.', 'fault');
    });
  });
  root.append(el('h2', { text: 'Files' }), el('div', { class: 'row' },
    el('a', { class: 'button small', href: app.line.address('/surface.toml'), download: 'surface.toml', text: 'surface.toml' })),
  el('p', { class: 'quiet', text: 'The drive and the report of the last measurement are under Measure.' }));
}
