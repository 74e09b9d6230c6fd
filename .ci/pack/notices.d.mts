export interface Notice {
  readonly name: string;
  readonly version: string;
  readonly license: string;
  readonly texts: readonly string[];
  readonly purl: string;
}
export function npmNotices(root: string, from: { workspaces?: string[]; packages?: string[] }): Notice[];
export function noticesText(what: string, notices: readonly Notice[]): string;
export function pageCargoNotices(root: string): Notice[];
export function cargoNotices(root: string, of?: { crate?: string; platform?: string }): Notice[];
