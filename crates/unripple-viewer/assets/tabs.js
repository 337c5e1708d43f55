// The panels' tabs: one shown at a time, arrows move between them.

/** Tabs of the page; `changed(name)` after each change. */
export class Tabs {
  constructor(state) {
    this.state = state;
    this.tabs = [...document.querySelectorAll('[role="tab"]')];
    this.names = this.tabs.map((tab) => tab.id.replace('tab-', ''));
    const list = document.querySelector('[role="tablist"]');
    list.addEventListener('click', (event) => {
      const tab = event.target.closest('[role="tab"]');
      if (tab) this.show(tab.id.replace('tab-', ''));
    });
    list.addEventListener('keydown', (event) => this.#key(event));
    this.show(this.names.includes(state.ui.tab) ? state.ui.tab : 'touch');
  }

  get shown() {
    return this.name;
  }

  show(name) {
    if (!this.names.includes(name)) return;
    this.name = name;
    for (const tab of this.tabs) {
      const chosen = tab.id === `tab-${name}`;
      tab.setAttribute('aria-selected', String(chosen));
      tab.tabIndex = chosen ? 0 : -1;
      document.getElementById(tab.getAttribute('aria-controls')).hidden = !chosen;
    }
    this.state.ui.tab = name;
    this.state.publish('tab', { name });
  }

  #key(event) {
    const at = this.names.indexOf(this.name);
    const last = this.names.length - 1;
    const next = { ArrowRight: at === last ? 0 : at + 1, ArrowLeft: at === 0 ? last : at - 1, Home: 0, End: last }[event.key];
    if (next === undefined) return;
    event.preventDefault();
    this.show(this.names[next]);
    this.tabs[next].focus();
  }
}
