/** Opening without a network, and newer versions. */
export const offline = {
  ready: "A newer version of Twincell is here. Your cells are kept.",
  take: "Use it now",
  later: "Later",
  noWorker: "This page cannot be kept for use without a network: open it over https or on localhost.",
  "notKept(why)": "This page is not kept for use without a network: {why}",
};
