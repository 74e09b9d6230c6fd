import { BUDGET_OPTION, type SharedBudget } from "../octree/index.js";
import {
  above,
  type Kind,
  type Kinds,
  kindOf,
  number,
  oneOf,
  optionPlace,
  signal,
  some,
  text,
  whole,
  withMethods,
} from "../options/index.js";
import type { OpenOptions } from "../sources/open-source.js";
import type { NodeExecutor, PoolOptions } from "../workers/index.js";
import type { GeoreferenceOptions } from "./georeference-options.js";
import type { HeightData } from "./height-data.js";
import type { StreamLimits } from "./node-stream.js";

/** How a data set is opened. */
export interface PointCloudOptions extends GeoreferenceOptions, OpenOptions {
  /** Where nodes are decoded. Default: an own pool of workers. */
  readonly executor?: NodeExecutor | undefined;
  /** Options of that pool. */
  readonly workers?: PoolOptions | undefined;
  /** How much is loaded at once and kept. */
  readonly limits?: StreamLimits | undefined;
  /** Budget that several clouds share; its bytes hold for what is kept. Default: none. */
  readonly budget?: SharedBudget | undefined;
}

/** Milliseconds. Twelve times that, the longest that is waited, is still a time that timers can count. */
const DAY = 86_400_000;

const callback: Kind<never> = kindOf("a function", (given): given is never => typeof given === "function");

/** What each option of a data set may be. */
export const CLOUD_OPTIONS: Kinds<PointCloudOptions> = {
  crs: text,
  vertical: text,
  epsg: callback,
  epsgTable: callback,
  heightData: withMethods<HeightData>("an object with the methods systems and egm96", "systems", "egm96"),
  transformation: kindOf(
    "an address, a File or Blob, or the bytes of a georeference",
    (given): given is NonNullable<PointCloudOptions["transformation"]> =>
      typeof given === "string" ||
      typeof given === "function" ||
      (typeof given === "object" && given !== null && !Array.isArray(given)),
  ),
  tolerance: above(0),
  headers: kindOf(
    "an object of headers, or a function that gives them",
    (given): given is NonNullable<PointCloudOptions["headers"]> =>
      typeof given === "function" || (typeof given === "object" && given !== null && !Array.isArray(given)),
  ),
  credentials: oneOf("omit", "same-origin", "include"),
  timeout: number(1, DAY),
  retry: some({ attempts: whole(1), backoff: number(0, DAY), patience: number(0) }),
  headLength: whole(1),
  onWait: callback,
  signal,
  executor: withMethods<NodeExecutor>("an executor of nodes", "addDataSet", "removeDataSet"),
  workers: some<PoolOptions>({ size: whole(1), createWorker: callback, jobTimeout: number(1, DAY) }),
  limits: some<StreamLimits>({
    requests: number(1),
    cacheBytes: number(0),
    knownNodes: number(1),
    budget: BUDGET_OPTION,
  }),
  budget: BUDGET_OPTION,
};

/** Options with which a data set can be opened; what is left out stays out. @throws StyleError STYLE_OPTION */
export function checkCloudOptions(options: PointCloudOptions): PointCloudOptions {
  return some(CLOUD_OPTIONS).read(options, optionPlace("options", "PointCloud.fromUrl"));
}
