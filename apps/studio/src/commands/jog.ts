import { goThere } from "../runtime/jog/go-to-point.ts";
import type { Command } from "../stores/commands.ts";
import { cycleOrientationPreset } from "../runtime/jog/orientation-presets.ts";
import { cancelTrace, makeTrace } from "../runtime/planning/trace-command.ts";
import { theRobot } from "../stores/document.ts";
import { jogStore, type JogFrame } from "../stores/jog.ts";
import { traceStore } from "../stores/trace.ts";
import { showMode } from "../stores/view.ts";
import { words } from "../messages/index.ts";

const FRAMES: readonly JogFrame[] = ["joint", "base", "tool", "user", "world"];

export const jogCommands = (): readonly Command[] => [
  {
    id: "jog.ready",
    group: "jog",
    words: words.commands.ready,
    keys: ["H"],
    can: () => theRobot() !== null,
    run: () => {
      const robot = theRobot();
      if (robot) {
        jogStore.setState({ aid: null, blocked: null });
        goThere(robot, robot.home_rad);
      }
    },
  },
  {
    id: "jog.zero",
    group: "jog",
    words: words.commands.zero,
    can: () => theRobot() !== null,
    run: () => {
      const robot = theRobot();
      if (robot)
        goThere(
          robot,
          robot.home_rad.map(() => 0),
        );
    },
  },
  {
    id: "jog.aid-next",
    group: "jog",
    words: words.commands.aidNext,
    keys: ["N"],
    can: () => theRobot() !== null,
    run: () => cycleOrientationPreset(1),
  },
  {
    id: "jog.aid-previous",
    group: "jog",
    words: words.commands.aidPrevious,
    keys: ["B"],
    can: () => theRobot() !== null,
    run: () => cycleOrientationPreset(-1),
  },
  ...FRAMES.map(
    (frame): Command => ({
      id: `jog.frame-${frame}`,
      group: "jog",
      words: words.commands.frame(words.jog.frames[frame]),
      run: () => jogStore.setState({ frame, blocked: null }),
    }),
  ),
  {
    id: "trace.toggle",
    group: "program",
    words: words.commands.trace,
    keys: ["T"],
    run: () => {
      showMode("teach");
      traceStore.setState(({ active }) => ({ active: !active, hovered: null }));
    },
  },
  {
    id: "trace.make",
    group: "program",
    words: words.trace.make,
    can: () => traceStore.getState().chosen.length > 0 && !traceStore.getState().working,
    run: makeTrace,
  },
  {
    id: "trace.cancel",
    group: "program",
    words: words.common.cancel,
    can: () => traceStore.getState().working,
    run: cancelTrace,
  },
];
