import "@fontsource-variable/inter/wght.css";
import { createRoot } from "react-dom/client";
import { App } from "./App.tsx";
import { boot } from "./boot.ts";
import { exposeStores } from "./console.ts";
import "./tokens.css";

boot();
exposeStores();
createRoot(document.getElementById("root")!).render(<App />);
