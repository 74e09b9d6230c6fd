export { fetchModule } from "./fetch-module.js";
export { type ChunkFormat, LazModule, type LazTask, type RecordLayout } from "./laz-module.js";
