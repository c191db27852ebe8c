import { expect, test } from "vitest";
import { whatEnded, whyNotEntered } from "./session-sentences.ts";

const thrown = (name: string): DOMException => new DOMException("raw words of the browser", name);

test("permission refused, no floor, a headset in use: each is one sentence with a way on", () => {
  for (const name of ["NotAllowedError", "SecurityError", "NotSupportedError", "InvalidStateError"]) {
    const { sentence, hint } = whyNotEntered(thrown(name));
    expect(sentence).toMatch(/^[A-Z].*\.$/);
    expect(sentence).not.toContain("raw words");
    expect(hint).toMatch(/press Headset again\.$/);
  }
  expect(whyNotEntered(thrown("NotAllowedError"))).toEqual({
    sentence: "The browser was not allowed to start the headset.",
    hint: "Allow virtual reality for this page in the settings of the site, then press Headset again.",
  });
  expect(whyNotEntered(new Error("no display")).sentence).toBe("The headset was not started: no display");
});

test("an end that nobody asked for is told, one with the tool in hand with what became of it", () => {
  expect(whatEnded("left")).toBeNull();
  expect(whatEnded("ended")).toMatch(/nothing is lost; press Headset to go on\.$/);
  expect(whatEnded("ended-held")).toMatch(/it was let go and stands where it was\. Press Headset to go on\.$/);
});
