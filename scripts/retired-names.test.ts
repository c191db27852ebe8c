import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { expect, test } from "vitest";

const root = fileURLToPath(new URL("..", import.meta.url));
const tracked = execFileSync("git", ["ls-files", "packages", "apps", "bench", "examples", "scripts"], {
  cwd: root,
  encoding: "utf8",
})
  .trim()
  .split("\n")
  .filter(file => /\.(ts|tsx|mjs)$/.test(file) && !file.endsWith("retired-names.test.ts"));
const words = new Map(
  tracked.map(file => [file, new Set(readFileSync(root + file, "utf8").match(/[A-Za-z_$][\w$]*/g) ?? [])]),
);

/** Whole identifiers that docs/glossary.md replaced; plain words are not in here. */
const RETIRED = `
  AID_COUNT AbbEgmFaceOptions AbbFaceOptions ActNote ActWords AskOf BRAND_LIST BrandStarted BrandStation
  BrandVirtual BrandVirtualOptions C3_MOST_BYTES CabinetAct CabinetLink CabinetOpened CabinetOptions CabinetShown
  CabinetView CabinetWire CabinetWords ClutchManner DressedArm DressedSurface FaceEvents FaceMotion FaceOptions
  FanucFaceOptions ForgivingReader FromLayOut GuideEvents GuideOptions GuidedBench HELD_ACTIONS HandedText
  HeldParts HostOptions HostPlace HostedArmed HostedGroup HostedMember HostedPendant HostedSeat HostedStation
  KukaFaceOptions KukaRsiFaceOptions LEAST_AHEAD_S LEAST_TURN LaidOut LayOut LayOutQuestion LinePostures
  MOST_AHEAD_S MOST_COORDINATES MOST_CORNERS MOST_DATA_BYTES MOST_FILE MOST_MOTIONS MOST_PIECES MOST_POINTS
  MOST_TIMES MOST_UNDER_WAY MoveHappening NearFace OfferedBrand OpenedBrand OpenedStation OtherWay PendantVisit
  PostureFinder PostureMap PostureTree SolidShelf StationJob StationOptions StationWords StaubliFaceOptions
  StepHappening TellOf TipFeeler ToLayOut TurnSequence UNSAYABLE VideoAsk VideoSeat VideoTell VideoTellOf
  WayChecker WayOptions WayOutcome WayRound WayRoundOptions WayRules WayWorld YaskawaFace YaskawaFaceOptions
  abbEgmFace abbFace actNote actWords aidOrientation askOrEnd askSchema basicDoors blockDoors brandById brandsFor
  browserShelf cabinetOf canBeMet chosenAidAxis createCabinetLink createCs7Face createFanucFace createGuide
  createHost createKukaFace createKukaRsiFace createPlugInFace createStation createStaubliFace createUrFace
  cycleAid doorOf drawPosture dressArm easyPosture endGlide findWay findWayRound fromTurns glideAlong glideTo
  guidedBench isSingularPosture layOutElsewhere leastSingularValue memoryShelf namesPostures nearFace
  newSurroundings nextAid notGuided notGuidedBecause onHosts onSpoiledSample onlyAsks openCabinet openDoors
  openStation palletPlaces postureRepairs posturesAlongLine posturesOf randomPosture reachOfPosture readAsk
  readTell readVideoAsk readVideoTell recordHost singularPosture solidWords startTogether stationDoor tellSchema
  tellSkipped toTurns togetherCarried turnsInside videoDoor visitPendant wayBlocked wentSilent yaskawaFace
`
  .trim()
  .split(/\s+/);

test("names that docs/glossary.md replaced are not used any more", () => {
  const used = RETIRED.flatMap(name =>
    [...words].filter(([, known]) => known.has(name)).map(([file]) => `${name}: ${file}`),
  );
  expect(used).toEqual([]);
});

test("folders that got the field's name do not come back", () => {
  const retired = [
    "packages/messages/",
    "apps/studio/src/live/",
    "apps/studio/src/cabinet/",
    "packages/controllers/src/real/",
  ];
  expect(tracked.filter(file => retired.some(folder => file.startsWith(folder)))).toEqual([]);
});
