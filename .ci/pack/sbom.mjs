import { createHash } from "node:crypto";

/** Of a licence in words what CycloneDX takes as an expression of SPDX. */
const isExpression = (license) => /^\(?[A-Za-z0-9.+-]+( (OR|AND|WITH) [A-Za-z0-9.+()-]+)*\)?$/.test(license);

/**
 * The software bill of materials of a package, as CycloneDX 1.6: what it contains of others or needs to run, crates and
 * PROJ too, which npm does not know of. The same for the same package.
 *
 * @param {{ name: string, version: string, notices: import("./notices.mjs").Notice[] }} one
 */
export function billOfMaterials({ name, version, notices }) {
  const component = (type, of, license) => ({
    ...{ type, "bom-ref": of.purl, name: of.name, version: of.version, purl: of.purl },
    licenses: [isExpression(license) ? { expression: license } : { license: { name: license } }],
  });
  const components = notices.map((notice) =>
    component("library", notice, notice.license.replaceAll("/", " OR ")),
  );
  const own = { name, version, purl: `pkg:npm/${name.replace("@", "%40")}@${version}` };
  const digest = createHash("sha256")
    .update(JSON.stringify([own, components]))
    .digest("hex");
  const serial = digest.replace(/^(.{8})(.{4}).(.{3}).(.{3})(.{12}).*$/, "$1-$2-4$3-8$4-$5");
  const bill = {
    ...{ bomFormat: "CycloneDX", specVersion: "1.6", serialNumber: `urn:uuid:${serial}`, version: 1 },
    metadata: { component: component("application", own, "MIT") },
    components,
  };
  return `${JSON.stringify(bill, null, 2)}\n`;
}
