import { Color, Mesh, type Material, MeshStandardMaterial, type Object3D } from "three";
import { onTouching, touchingNow } from "../runtime/live.ts";

const originals = new WeakMap<Mesh, Material | Material[]>();
const red = new MeshStandardMaterial({
  color: "#d5201a",
  roughness: 0.5,
  emissive: new Color("#8f0d08"),
  emissiveIntensity: 0.55,
});

/** Paints every mesh below `root` red, or gives it back what it wore (rows N-48, N-49). */
export function paint(root: Object3D, touching: boolean): void {
  root.traverse(object => {
    if (!(object instanceof Mesh) || object.userData.unpainted === true) return;
    const original = originals.get(object);
    if (touching && original === undefined) {
      originals.set(object, object.material);
      object.material = red;
    }
    if (!touching && original !== undefined) {
      object.material = original;
      originals.delete(object);
    }
  });
}

/** Keeps the solids that `find` knows painted as the live contacts say. Returns the unsubscriber. */
export function paintTouching(find: (name: string) => Object3D | null): () => void {
  let painted: readonly Object3D[] = [];
  const apply = (names: ReadonlySet<string>): void => {
    const now = [...names].map(find).filter(object => object !== null);
    for (const object of painted) if (!now.includes(object)) paint(object, false);
    for (const object of now) paint(object, true);
    painted = now;
  };
  apply(touchingNow());
  const stop = onTouching(apply);
  return () => {
    stop();
    for (const object of painted) paint(object, false);
  };
}
