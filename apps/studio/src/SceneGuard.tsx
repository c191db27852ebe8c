import { Component, type ReactNode } from "react";
import { words } from "./messages/index.ts";

/** Without WebGL the page lives on: tree, pendant, program and export need no picture. */
export class SceneGuard extends Component<{ readonly children: ReactNode }, { readonly trouble: string | null }> {
  override state: { readonly trouble: string | null } = { trouble: null };
  static getDerivedStateFromError(problem: unknown): { readonly trouble: string } {
    return { trouble: problem instanceof Error ? problem.message : String(problem) };
  }
  override render(): ReactNode {
    if (this.state.trouble === null) return this.props.children;
    return (
      <div className="scene-note" role="alert">
        <p>
          <b>{words.app.sceneTrouble}</b> {this.state.trouble}
        </p>
        <p>{words.app.sceneHint}</p>
      </div>
    );
  }
}
