import { offlineStore } from "../stores/offline.ts";
import { words } from "../messages/index.ts";

/** The first pictures of the cell come before the files of its rarer parts [ms]. */
const LATER_MS = 4000;

/**
 * Lets the page open without a network from the second visit on. A newer version is fetched beside this one and waits
 * in the store until a person takes it.
 *
 * @param save  brings everything a person made to the disk; called before the page is opened anew.
 */
export function startOffline(save: () => Promise<void>): void {
  if (!("serviceWorker" in navigator)) {
    offlineStore.setState({ state: "unsupported", why: words.offline.noWorker });
    return;
  }
  const { serviceWorker } = navigator;
  // A worker that replaces another asks whether this page works.
  serviceWorker.addEventListener("message", event => {
    if (event.data === "are-you-there") event.ports[0]?.postMessage("here");
  });
  serviceWorker.startMessages();
  let taken = false;
  serviceWorker.addEventListener("controllerchange", () => {
    // The first worker also comes to control the page: that one is not opened anew.
    if (taken) location.reload();
  });
  const take = (registration: ServiceWorkerRegistration) => (): void => {
    void save().then(
      () => {
        taken = true;
        registration.waiting?.postMessage("take-over");
      },
      // What is not saved is not risked: the next save says why it could not be.
      () => undefined,
    );
  };
  const look = (registration: ServiceWorkerRegistration): void => {
    const waits = registration.waiting !== null && serviceWorker.controller !== null;
    offlineStore.setState({
      state: registration.active ? "kept" : "keeping",
      update: waits ? take(registration) : null,
    });
  };
  const register = async (): Promise<void> => {
    const registration = await serviceWorker.register("./sw.js", { updateViaCache: "none" });
    look(registration);
    registration.addEventListener("updatefound", () => {
      registration.installing?.addEventListener("statechange", () => {
        look(registration);
      });
    });
    registration.installing?.addEventListener("statechange", () => {
      look(registration);
    });
    await navigator.storage.persist();
  };
  setTimeout(() => {
    register().catch((problem: unknown) => {
      offlineStore.setState({
        state: "unsupported",
        why: words.offline.notKept(problem instanceof Error ? problem.message : String(problem)),
      });
    });
  }, LATER_MS);
}
