// Dark or light: as the system says, until a person says otherwise.

const SHORT = { system: 'Theme: auto', dark: 'Theme: dark', light: 'Theme: light' };
const NEXT = { system: 'dark', dark: 'light', light: 'system' };

/** Sets the theme and its button. */
export function startTheme(state) {
  const button = document.getElementById('theme');
  const system = matchMedia('(prefers-color-scheme: light)');
  const apply = () => {
    const wish = state.ui.theme ?? 'system';
    const name = wish === 'system' ? (system.matches ? 'light' : 'dark') : wish;
    document.documentElement.dataset.theme = name;
    button.textContent = SHORT[wish] ?? wish;
    button.removeAttribute('aria-label');
    button.title = 'Theme: as the system, dark or light';
    if (state.last('theme')?.name !== name) state.publish('theme', { name });
  };
  button.addEventListener('click', () => {
    state.ui.theme = NEXT[state.ui.theme ?? 'system'] ?? 'system';
    apply();
  });
  system.addEventListener('change', apply);
  apply();
}
