/** What a data set is known by where it is not at hand. */
export interface DatasetName {
  readonly dataset: string;
  /** Undefined where nobody has told. */
  readonly identity?: string | undefined;
}

/** A data set as far as it is told from others. */
export interface NamedDataset {
  readonly name: string;
  readonly identity?: string | undefined;
}

/** What is kept of a data set so that it is found again. */
export function datasetOf({ name, identity }: NamedDataset): DatasetName {
  return { dataset: name, ...(identity !== undefined && { identity }) };
}

/**
 * The data set that is meant: the one with the same points, whatever its file is called by now; where these are not known,
 * the one of that name, if there is no other of that name.
 */
export function datasetAmong<Dataset extends NamedDataset>(
  open: readonly Dataset[],
  { dataset, identity }: DatasetName,
): Dataset | undefined {
  const named = open.filter(({ name }) => name === dataset);
  if (identity !== undefined) {
    const same = (one: Dataset) => one.identity === identity;
    const untold = named.find((one) => one.identity === undefined);
    return named.find(same) ?? open.find(same) ?? untold;
  }
  const [first, ...others] = named;
  return others.every((one) => one.identity !== undefined && one.identity === first.identity)
    ? first
    : undefined;
}

/** Why {@link datasetAmong} finds none, in English. */
export function whyNotAmong(open: readonly NamedDataset[], { dataset, identity }: DatasetName): string {
  const named = open.filter(({ name }) => name === dataset);
  if (named.length === 0) return `${dataset} is not open`;
  return identity === undefined
    ? `several data sets named ${dataset} are open`
    : `the ${dataset} that is open has other points than the one that was measured, or was converted again`;
}
