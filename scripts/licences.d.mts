/** A package of a release. */
export interface Released {
  readonly name: string;
  readonly version: string;
  readonly licence: string;
}
/** Packages of the lock file that are not for development alone. */
export function released(): Released[];
/** Whether a licence text such as "(MIT OR Apache-2.0)" leaves a choice that is allowed. */
export function isAllowed(part: Released): boolean;
