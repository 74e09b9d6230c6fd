import { buildModuleUrl } from "cesium";
import { StrictMode } from "react";
import { createRoot } from "react-dom/client";
import { Globe } from "./globe.jsx";

buildModuleUrl.setBaseUrl("/cesium/");
const url = new URLSearchParams(location.search).get("cloud");
createRoot(document.getElementById("root")).render(
  <StrictMode>
    <Globe url={url} style={{ color: "elevation" }} />
  </StrictMode>,
);
