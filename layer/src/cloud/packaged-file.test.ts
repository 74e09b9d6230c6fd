import { expect, it } from "vitest";
import { packagedModule } from "./packaged-file.js";

it("SOURCE_MODULE where a part of the library is not to be had, and its code where it is", async () => {
  const gone = () => Promise.reject(new TypeError("Failed to fetch dynamically imported module"));
  await expect(packagedModule(gone)).rejects.toThrow(
    expect.objectContaining({ code: "SOURCE_MODULE", cause: expect.stringContaining("Failed to fetch") }),
  );
  await expect(packagedModule(() => import("./packaged-file.js"))).resolves.toMatchObject({ packagedModule });
});
