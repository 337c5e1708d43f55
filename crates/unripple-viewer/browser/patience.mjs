// How long tests wait: in processor time of what they have started. On a busy machine seconds pass in which nothing of it can work.

import { readFileSync, readdirSync } from 'node:fs';

/** Longest that anything is waited for, in ms of processor time; on an idle machine that is hardly less by the clock. */
export const PATIENCE = 20000;

/** How many times as long it is waited for by the clock, where the time goes by without work. */
export const BY_THE_CLOCK = 10;

/** Length of a tick of processor time, in ms, as Linux counts it. */
const TICK = 10;

/** Processor time that processes have used, in ms, by their numbers; with their parents. Nothing where there is no /proc. */
function processes() {
  const found = new Map();
  const numbers = () => {
    try {
      return readdirSync('/proc').filter((name) => /^\d+$/.test(name));
    } catch {
      return [];
    }
  };
  for (const number of numbers()) {
    try {
      // The name of a program, in brackets, may hold spaces and brackets itself.
      const [, parent, ...rest] = readFileSync(`/proc/${number}/stat`, 'utf8').split(') ').at(-1).split(' ');
      // User and system time, its own and of its children that have ended.
      const ticks = rest.slice(9, 13).reduce((sum, ticks) => sum + Number(ticks), 0);
      found.set(Number(number), { parent: Number(parent), spent: TICK * ticks });
    } catch {
      // It has ended meanwhile.
    }
  }
  return found;
}

/**
 * Processor time of each program that this one has started, with all that it has started in turn, in ms, by their numbers: viewers and the
 * browser. `null` where nobody counts it.
 */
export function spent() {
  const all = processes();
  if (!all.has(process.pid)) return null;
  const started = (number) => {
    for (let at = number; all.has(at); at = all.get(at).parent) {
      if (all.get(at).parent === process.pid) return at;
    }
    return null;
  };
  const sums = new Map();
  for (const [number, { spent: more }] of all) {
    const whose = started(number);
    if (whose !== null) sums.set(whose, (sums.get(whose) ?? 0) + more);
  }
  return sums;
}

/**
 * A wait that begins now; `over` says whether it has taken too long: by the clock, and in processor time of the viewer and of the browser each.
 * Together would not do: a browser that draws in software takes all that it gets, and what is waited for may be the other's work.
 */
export function wait(patience = PATIENCE) {
  const [began, before] = [Date.now(), spent()];
  return {
    over() {
      const passed = Date.now() - began;
      if (passed <= patience) return false;
      if (before === null || passed > BY_THE_CLOCK * patience) return true;
      return [...spent()].every(([number, now]) => now - (before.get(number) ?? 0) > patience);
    },
  };
}
