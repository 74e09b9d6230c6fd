import { type NamedCloud, nameClouds } from "./address.js";
import type { Clouds, OpenCloud } from "./clouds/clouds.js";

/** The clouds that an address can name, which a file of the reader's disk has none of: the chosen one first. */
export function addressed({ all, chosen }: Clouds): (OpenCloud & { readonly from: string })[] {
  const order = [...(chosen ? [chosen] : []), ...all.filter((one) => one !== chosen)];
  return order.flatMap((cloud) => (typeof cloud.from === "string" ? [{ ...cloud, from: cloud.from }] : []));
}

/** Has an address of the page name the clouds that it shows. */
export function nameIn(page: URL, clouds: Clouds): void {
  const named = addressed(clouds).map(({ from, crs, how: { vertical, transformation } }): NamedCloud => {
    const georef = typeof transformation === "string" ? transformation : undefined;
    return { address: from, crs, vertical, georef };
  });
  nameClouds(page, named);
}

/** Keeps the page's own address in step with what it shows, so that it can be reloaded and passed on. */
export function rememberClouds(clouds: Clouds): void {
  const page = new URL(location.href);
  nameIn(page, clouds);
  // A link to a view is one of the cloud that it was made for.
  page.hash = "";
  history.replaceState(null, "", page);
}
