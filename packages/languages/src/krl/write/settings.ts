import type { MoveStep, Speed } from "@twincell/core";
import { singleText } from "../../parser/index.ts";
import { lengthText } from "./location.ts";

/** Slowest speed of a path that is written [m/s]. */
const SLOWEST_MPS = 1e-4;

/**
 * Axis speed in whole percent, as $VEL_AXIS holds it. A speed of the tool is only its share of the robot's greatest.
 */
export function percentOf(speed: Speed, maxTcpSpeed_mps: number): number {
  const ratio = "ratio" in speed ? speed.ratio : "mps" in speed ? speed.mps / maxTcpSpeed_mps : 1;
  return Math.min(100, Math.max(1, Math.round(ratio * 100)));
}

/** Speed of a path, as $VEL.CP holds it. */
export function pathSpeed(speed: Speed, maxTcpSpeed_mps: number): number {
  const mps = "mps" in speed ? speed.mps : "ratio" in speed ? speed.ratio * maxTcpSpeed_mps : maxTcpSpeed_mps;
  return Math.max(SLOWEST_MPS, mps);
}

/**
 * What the controller keeps from one motion to the next. Only what changes is said; `forget` makes everything be said
 * again, at places that are reached from several sides.
 */
export class Settings {
  tool: string | undefined;
  base: string | undefined;
  private ptpVelocity = "";
  private ptpAcceleration = "";
  private pathVelocity = "";
  private pathAcceleration = "";
  private distance = "";
  private percent = "";
  private readonly maxTcpSpeed_mps: number;

  constructor(maxTcpSpeed_mps: number) {
    this.maxTcpSpeed_mps = maxTcpSpeed_mps;
    // BAS(#INITMOV,0) takes tool and base off and full acceleration on.
    this.tool = "flange";
    this.base = "world";
    this.ptpAcceleration = this.pathAcceleration = "100";
  }

  forget(): void {
    this.tool = this.base = undefined;
    this.ptpVelocity =
      this.ptpAcceleration =
      this.pathVelocity =
      this.pathAcceleration =
      this.distance =
      this.percent =
        "";
  }

  /** The lines that must stand before the motion, its speed and acceleration. */
  pace({ path, speed, acceleration }: MoveStep): string[] {
    const lines: string[] = [];
    const share = Math.max(1, Math.round((acceleration?.ratio ?? 1) * 100));
    if (path === "ptp") {
      const velocity = String(percentOf(speed, this.maxTcpSpeed_mps));
      if (velocity !== this.ptpVelocity) lines.push(`BAS(#VEL_PTP,${velocity})`);
      if (String(share) !== this.ptpAcceleration) lines.push(`BAS(#ACC_PTP,${share})`);
      this.ptpVelocity = velocity;
      this.ptpAcceleration = String(share);
      return lines;
    }
    const velocity = singleText(pathSpeed(speed, this.maxTcpSpeed_mps));
    if (velocity !== this.pathVelocity) lines.push(`$VEL.CP=${velocity}`);
    if (String(share) !== this.pathAcceleration) lines.push(`$ACC.CP=DEF_ACC_CP*${singleText(share / 100)}`);
    this.pathVelocity = velocity;
    this.pathAcceleration = String(share);
    return lines;
  }

  /** The same for one motion only: what the controller keeps stays as it is. */
  once(step: MoveStep): string[] {
    const { ptpVelocity, ptpAcceleration, pathVelocity, pathAcceleration } = this;
    const lines = this.pace(step);
    Object.assign(this, { ptpVelocity, ptpAcceleration, pathVelocity, pathAcceleration });
    return lines;
  }

  /** How the point is passed: the lines before the motion, and what stands behind its target. */
  passing(
    { path, blend_ratio = 0 }: MoveStep,
    blend_m: number,
  ): { readonly lines: readonly string[]; readonly word: string } {
    if (path === "ptp" && blend_ratio > 0) {
      const percent = String(Math.min(100, Math.max(1, Math.round(blend_ratio * 100))));
      const lines = percent === this.percent ? [] : [`$APO.CPTP=${percent}`];
      this.percent = percent;
      return { lines, word: " C_PTP" };
    }
    if (!(blend_m > 0)) return { lines: [], word: "" };
    const distance = lengthText(blend_m);
    const lines = distance === this.distance ? [] : [`$APO.CDIS=${distance}`];
    this.distance = distance;
    return { lines, word: " C_DIS" };
  }
}
