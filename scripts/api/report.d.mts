/** Where the reports are kept. */
export const reportFolder: URL;
/** The report of every package by its file name, from the sources as they are. */
export function publicApiReports(): Map<string, string>;
