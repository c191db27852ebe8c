import { Component, type ReactNode } from "react";
import { words } from "./messages/index.ts";

/** Without WebGL the page lives on: tree, pendant, program and export need no picture. */
export class SceneGuard extends Component<{ readonly children: ReactNode }, { readonly trouble: string | null }> {
  override state: { readonly trouble: string | null } = { trouble: null };
  static getDerivedStateFromError(faultInjection: unknown): { readonly trouble: string } {
    return { trouble: faultInjection instanceof Error ? faultInjection.message : String(faultInjection) };
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
