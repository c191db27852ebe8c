// Makes the picture of the README from the studio itself: node scripts/picture.mjs
import { writeFileSync } from "node:fs";
import { saveDocument, tracedCartonCell } from "@twincell/project";
import { drawn, Studio } from "../apps/studio/browser-tests/support/studio.ts";
import { root } from "./prepare.mjs";

const studio = await Studio.start();
const { page } = await studio.open({ width: 1280, height: 800, theme: "dark" });
await drawn(page);
await page.evaluate(text => {
  window.twincell.document.open(text, "traced-carton.json");
  window.twincell.stores.viewStore.setState({ coachDone: true });
}, saveDocument(tracedCartonCell()));
await page.waitForFunction(() => window.twincell.stores.playStore.getState().verdict !== null, null, { polling: 200 });
await page.evaluate(() => {
  window.twincell.run("view.fit");
  for (const { id } of window.twincell.stores.noticeStore.getState().notices)
    window.twincell.stores.noticeStore.setState({
      notices: window.twincell.stores.noticeStore.getState().notices.filter(notice => notice.id !== id),
    });
  window.twincell.stores.viewStore.setState({ mode: "check" });
  window.twincell.seek(20.5);
});
// The drawing gets sharp when it rests.
const frames = await page.evaluate(() => window.twincellScene.frames);
await page.waitForFunction(before => window.twincellScene.frames > before + 2, frames, { polling: 100 });
await page.evaluate(
  () =>
    new Promise(resolve => {
      setTimeout(resolve, 1500);
    }),
);
writeFileSync(`${root}docs/studio.png`, await page.screenshot());
await studio.stop();
