// SPDX-License-Identifier: GPL-3.0-or-later
// What was done, step by step: a click goes there, by so many times undo or redo.
import { useEffect, useState } from "preact/hooks";
import type { Done, Status } from "./protocol";

interface Props {
  status: Status;
  told: number;
  ask(): Promise<Done>;
  go(steps: number): void;
}

/** `told`: changes with each mesh, so that steps which took others' places are seen. */
export function History({ status, told, ask, go }: Props) {
  const [isOpen, setOpen] = useState(false);
  const [steps, setSteps] = useState<{ first: number; names: string[] }>({ first: 0, names: [] });
  useEffect(() => {
    if (isOpen)
      ask().then(
        (done) => setSteps({ first: done.first ?? 0, names: done.steps ?? [] }),
        () => undefined,
      );
  }, [isOpen, status.step, status.undo, status.redo, told]);
  return (
    <section aria-label="History">
      <details open={isOpen} onToggle={(e) => setOpen(e.currentTarget.open)}>
        <summary>History</summary>
        <ol class="history" start={steps.first}>
          {steps.names.map((name, i) => (
            <li key={steps.first + i}>
              <button
                class="small"
                aria-current={steps.first + i === status.step ? "step" : undefined}
                onClick={() => go(status.step - steps.first - i)}
              >
                {name}
              </button>
            </li>
          ))}
        </ol>
      </details>
    </section>
  );
}
