import type { Refusal } from "@twincell/core";
import type { GuardDenial } from "./state.ts";

const CLEARANCE_HINT = "Move another way round, or make room in the cell.";

/** Why the guard said no, in words. */
export function denialRefusal(denied: GuardDenial, robot: string, holder: string | null): Refusal {
  switch (denied) {
    case "lease-taken":
      return {
        code: "guard.lease-taken",
        sentence: `${robot} is commanded by ${holder ?? "somebody else"}.`,
        hint: "Wait until the lease is given back. Anyone may stop the robot.",
      };
    case "no-lease":
      return { code: "guard.no-lease", sentence: `Nobody has taken command of ${robot}.`, hint: "Take command first." };
    case "enabling-switch":
      return {
        code: "guard.enabling-switch",
        sentence: "The enabling switch is not pressed.",
        hint: "Keep it pressed for as long as the robot is to move.",
      };
    case "link-lost":
      return {
        code: "guard.link-lost",
        sentence: `The link to ${robot} is down.`,
        hint: "Mend the link, then confirm that motion is wanted.",
      };
    case "link-unconfirmed":
      return {
        code: "guard.link-unconfirmed",
        sentence: `The link to ${robot} was down and is back.`,
        hint: "Look at the robot, then confirm that motion is wanted.",
      };
    case "emergency":
      return {
        code: "safety.emergency-stop",
        sentence: `The drives of ${robot} are off after an emergency stop.`,
        hint: "Reset the robot, then command the move again.",
      };
    case "return-wanted":
      return {
        code: "guard.return-wanted",
        sentence: `${robot} stands too near to something.`,
        hint: "Confirm, and it goes back to its last safe pose.",
      };
    case "busy":
      return {
        code: "controller.busy",
        sentence: `${robot} is still carrying out the command before.`,
        hint: "Wait until it is done, or stop it.",
      };
    case "watching":
      return onlyWatched(robot);
    case "still-moving":
      return {
        code: "controller.braking",
        sentence: `${robot} has not come to rest yet.`,
        hint: "Reset it when it stands.",
      };
  }
}

export const onlyWatched = (robot: string): Refusal => ({
  code: "guard.watching",
  sentence: `${robot} was opened to watch: nothing is commanded from here.`,
  hint: "Take control first. A stop works all the same.",
});
export const watchedLinkDown = (robot: string, silent_s: number): Refusal => ({
  code: "guard.link-lost",
  sentence: `Nothing was heard of ${robot} for ${Math.round(silent_s * 1000)} ms. It is only watched and was not stopped.`,
  hint: "It is looked for by itself.",
});
export const targetTooNear: Refusal = {
  code: "guard.clearance",
  sentence: "At the target the robot would be nearer to something than the clearance margin.",
  hint: CLEARANCE_HINT,
};
export const cameTooNear: Refusal = {
  code: "guard.clearance",
  sentence: "The robot came within the clearance margin of something and was stopped.",
  hint: "It goes back to its last safe pose. " + CLEARANCE_HINT,
};
export const nowhereSafe: Refusal = {
  code: "guard.no-safe-pose",
  sentence: "The cell has changed: the last safe pose is within the clearance margin of something now.",
  hint: "Look at the robot and jog it away from what is near.",
};
export const linkWentDown = (robot: string, silent_s: number): Refusal => ({
  code: "guard.link-lost",
  sentence: `Nothing was heard of ${robot} for ${Math.round(silent_s * 1000)} ms; it was told to stop.`,
  hint: "Mend the link, then confirm that motion is wanted.",
});
export const commanderWentSilent = (who: string, silent_s: number): Refusal => ({
  code: "guard.commander-lost",
  sentence: `Nothing was heard of ${who} for ${Math.round(silent_s * 1000)} ms; the robot was told to stop.`,
  hint: "Reconnect, then confirm that motion is wanted.",
});
export const switchLetGo: Refusal = {
  code: "guard.enabling-switch",
  sentence: "The enabling switch was let go.",
  hint: "Keep it pressed for as long as the robot is to move.",
};
export const leaseGivenBack: Refusal = {
  code: "guard.no-lease",
  sentence: "Command was given back while the robot moved.",
  hint: "Take command again to go on.",
};
export const tooFast = (speed_mps: number, cap_mps: number): Refusal => ({
  code: "guard.speed",
  sentence: `The tool moved at ${Math.round(speed_mps * 1000)} mm/s in manual mode; the cap is ${Math.round(cap_mps * 1000)} mm/s.`,
  hint: "Command it slower, or switch to automatic.",
});
