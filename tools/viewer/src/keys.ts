// Which key does what?

export interface Command {
  keys: string[];
  /** What help has in place of the keys, where they are many. */
  keysText?: string;
  group: string;
  text: string;
  run: (key: string) => void;
}

let all: Command[] = [];

export function setCommands(commands: Command[]): void {
  all = commands;
}

export function commands(): Command[] {
  return all;
}

/** A key with the Shift, Alt and Ctrl that count. Signs such as ? have their Shift in them. */
function nameOf(event: KeyboardEvent): string {
  const isLetter = /^[a-z]$/i.test(event.key);
  // With Alt some systems type other signs, so digits are known by their place.
  const digit = /^Digit(\d)$/.exec(event.code)?.[1];
  const key = event.altKey && digit ? digit : isLetter ? event.key.toLowerCase() : event.key;
  const hasShift = event.shiftKey && (isLetter || key.length > 1);
  return (event.altKey ? 'Alt+' : '') + (hasShift ? 'Shift+' : '') + key;
}

export function listenForKeys(): void {
  addEventListener('keydown', (event) => {
    const target = event.target as HTMLElement;
    const isTyping = target instanceof HTMLInputElement && ['search', 'number', 'text'].includes(target.type);
    if (event.ctrlKey || event.metaKey || document.querySelector('dialog[open]')) return;
    if (isTyping) {
      if (event.key === 'Escape' || event.key === 'Enter') target.blur();
      return;
    }
    const isRange = target instanceof HTMLInputElement && target.type === 'range' && event.key.startsWith('Arrow');
    const isPress = target instanceof HTMLButtonElement && (event.key === ' ' || event.key === 'Enter');
    if (isRange || isPress) return;
    const name = nameOf(event);
    const command = all.find((c) => c.keys.includes(name));
    if (!command) return;
    event.preventDefault();
    command.run(name);
  });
}
