// What the page knows: the last message of each kind, and the page's own state that survives a reload.

const KEY = 'unripple.page';
const PASSING = new Set(['fault', 'notice']);

/** Something kept for this tab of the browser; storage may be forbidden, then it lives as long as the page. */
export const store = {
  get(key) {
    try {
      return sessionStorage.getItem(key);
    } catch {
      return null;
    }
  },
  set(key, value) {
    try {
      sessionStorage.setItem(key, value);
    } catch {
      // Full or forbidden: the page works without.
    }
  },
};

function persisted() {
  let kept = {};
  try {
    kept = JSON.parse(store.get(KEY) ?? '{}') ?? {};
  } catch {
    kept = {};
  }
  return new Proxy(kept, {
    set(target, name, value) {
      target[name] = value;
      store.set(KEY, JSON.stringify(target));
      return true;
    },
    deleteProperty(target, name) {
      delete target[name];
      store.set(KEY, JSON.stringify(target));
      return true;
    },
  });
}

/** A store of messages by kind with subscribers; `faulty(kind, error)` is called for a subscriber that threw. */
export function createState(faulty) {
  const kept = new Map();
  const subscribers = new Map();
  const call = (kind, fn, message) => {
    try {
      fn(message);
    } catch (error) {
      console.error(`${kind}:`, error);
      faulty(kind, error);
    }
  };
  return {
    ui: persisted(),
    last: (kind) => kept.get(kind) ?? null,
    publish(kind, message) {
      if (!PASSING.has(kind)) kept.set(kind, message);
      for (const fn of [...(subscribers.get(kind) ?? [])]) call(kind, fn, message);
    },
    subscribe(kind, fn) {
      if (!subscribers.has(kind)) subscribers.set(kind, new Set());
      subscribers.get(kind).add(fn);
      if (kept.has(kind)) call(kind, fn, kept.get(kind));
      return () => subscribers.get(kind).delete(fn);
    },
  };
}
