// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The crease authors

// Light or dark: as the system prefers, or as chosen.

const preferred = window.matchMedia('(prefers-color-scheme: dark)');
const listeners = [];
let chosen = '';

export const theme = {
  get dark() { return chosen ? chosen === 'dark' : preferred.matches; },
  get chosen() { return chosen; },

  /** 'light', 'dark' or '': as the system prefers. */
  choose(name) {
    chosen = name;
    apply();
  },

  onChange(listener) { listeners.push(listener); },
};

function apply() {
  document.documentElement.classList.toggle('dark', theme.dark);
  for (const listener of listeners) listener();
}

preferred.addEventListener('change', apply);
apply();
