// Brings the page to life. Without this script it is complete but for what the runs' tables say:
// texts, drawings and charts that stand still.
import { read_address, write_address } from './address.js';
import { redraw_charts } from './chart.js';
import { read_data } from './data.js';
import { make } from './dom.js';
import { add_figure } from './figure.js';
import { apply_filter, empty_filter, looked_at, make_filter_form, run_passes } from './filter.js';
import { tell_summary } from './first_screen.js';
import { listen_to_index, tell_index } from './index.js';
import { mend_stops, rove } from './rove.js';
import { Scenes } from './scenes.js';
import { make_sortable } from './sort.js';
import { summarize } from './summary.js';
import { make_theme_button, set_palette, start_theme } from './theme.js';

const kSchema = 'slipcheck-page/3';

function plots(selector, fill) {
  for (const element of document.querySelectorAll(`.plots[data-${selector}]`)) {
    fill(element, Number(element.dataset[selector]));
  }
}

/** The toolbar, and what of the page follows what is chosen there. */
class Page {
  constructor(data, toolbar) {
    this.data = data;
    this.filter = empty_filter();
    this.scene = '';  // the one that is looked at, by name
    const view = () => ({ filter: this.filter, passes: (run) => run_passes(this.filter, run) });
    this.scenes = new Scenes(data.scenes, view, (k) => this.look_at(k));
    this.form = make_filter_form(data.scenes, (filter) => this.choose(filter));
    this.total = `${data.scenes.length} scene${data.scenes.length === 1 ? '' : 's'}`;
    this.form.tell(`${data.scenes.length} of ${this.total}`);
    toolbar.append(this.form.form);
    for (const plain of document.querySelectorAll('fieldset.filter')) plain.remove();
    document.getElementById('scenes')?.prepend(make('p', { class: 'fold' },
      make('button', { type: 'button', onclick: () => this.scenes.open_all(true) }, 'Open all'), ' ',
      make('button', { type: 'button', onclick: () => this.scenes.open_all(false) }, 'Close all')));
    listen_to_index((k) => this.scenes.open(k));
    document.addEventListener('click', (event) => this.follow(event));
    window.addEventListener('hashchange', () => this.read());
  }

  choose(filter) {
    this.filter = { ...filter };
    const shown = this.data.scenes.map((scene) => looked_at(filter, scene)).filter(Boolean);
    apply_filter(filter, this.data.scenes, shown);
    tell_index(filter, this.data.scenes, this.data.methods, shown);
    tell_summary(summarize(shown));
    this.form.tell(`${shown.length} of ${this.total}`);
    mend_stops();
    redraw_charts();
    this.write();
  }

  look_at(k) {
    this.scene = this.data.scenes[k].name;
    this.write();
  }

  write() {
    const address = write_address(this.filter, this.scene);
    if (address !== window.location.hash && !this.is_reading) history.replaceState(null, '', address || window.location.pathname + window.location.search);
  }

  /** Takes what the address says. */
  read() {
    const wanted = read_address(decode(window.location.hash));
    if (!wanted) return this.open_id(window.location.hash.slice(1));
    this.is_reading = true;
    this.form.set(wanted.filter);
    this.is_reading = false;
    const k = this.data.scenes.findIndex(({ name }) => name === wanted.scene);
    if (k >= 0) this.scenes.open(k);
    return undefined;
  }

  open_id(id) {
    const k = this.data.scenes.findIndex((scene) => scene.id === id);
    if (k >= 0) this.scenes.open(k);
    return k >= 0;
  }

  /** Links to scenes open them. */
  follow(event) {
    const link = event.target.closest?.('a[href^="#scene-"]');
    if (link && this.open_id(link.getAttribute('href').slice(1))) event.preventDefault();
  }
}

function decode(hash) {
  try {
    return hash.includes('=') ? hash : decodeURIComponent(hash);
  } catch {
    return hash;
  }
}

async function start() {
  start_theme();
  for (const table of document.querySelectorAll('table')) {
    if (table.closest('section.scene')) continue;
    make_sortable(table);
    rove(table);
  }
  const data = await read_data(document.getElementById('slipcheck-data'));
  if (data && data.schema !== kSchema) throw new Error(`data of the schema ${data.schema}, not ${kSchema}`);
  const toolbar = document.getElementById('toolbar');
  const page = data?.scenes.length && toolbar ? new Page(data, toolbar) : null;
  toolbar?.append(make_theme_button());
  if (!data) return;
  set_palette(data.palette);
  plots('engines', (parent) => add_figure(parent, data.engines));
  plots('precision', (parent, k) => { if (data.precision[k].charts.length) add_figure(parent, data.precision[k].charts); });
  plots('map', (parent, k) => add_figure(parent, [data.stability.maps[k]]));
  plots('limits', (parent, k) => add_figure(parent, [data.stability.limits[k]]));
  if (window.location.hash) page?.read();
  document.documentElement.dataset.ready = '';
}

start();
