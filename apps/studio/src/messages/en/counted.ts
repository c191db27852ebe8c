export const plural = (count: number, one: string, many = `${one}s`): string => `${count} ${count === 1 ? one : many}`;

/** What of a text was left out, the worst of it by name. */
export function leftOut(all: readonly { readonly what: "motion" | "branch" | "statement" }[]): string {
  const count = (what: string): number => all.filter(each => each.what === what).length;
  const motions = count("motion");
  const branches = count("branch");
  if (motions + branches === 0) return `${plural(all.length, "statement")} left out.`;
  const worst = [
    motions > 0 ? plural(motions, "motion") : "",
    branches > 0 ? plural(branches, "branch", "branches") : "",
  ]
    .filter(each => each !== "")
    .join(" and ");
  return `${plural(all.length, "statement")} left out, among them ${worst}: the robot does not do what the text says.`;
}
