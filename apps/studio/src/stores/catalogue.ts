import { addCatalogue } from "@twincell/core";
import { openDocument, type Opened } from "@twincell/project";

let loading: Promise<void> | undefined;

/**
 * Makes the robots of the catalogue known to the page: their data are a file of their own, which the start does not
 * wait for.
 */
export function loadCatalogue(): Promise<void> {
  loading ??= import("@twincell/core/catalogue").then(
    ({ CATALOGUE }) => {
      addCatalogue(CATALOGUE);
    },
    (fault: unknown) => {
      loading = undefined; // The next one who wants it asks again.
      throw fault;
    },
  );
  return loading;
}

/** Opens the text of a saved cell; where that fails, again with the robots of the catalogue. */
export async function openSaved(text: string): Promise<Opened> {
  const opened = openDocument(text);
  if (opened.kind !== "not-a-cell") return opened;
  await loadCatalogue();
  return openDocument(text);
}
