import { ClearCommand, type Command, Pass } from "./cesium-private.js";

/**
 * A command that clears nothing and calls a function where Cesium comes to it: in every frustum, between the commands
 * of its pass before and after it in the list.
 */
export function hookCommand(owner: object, call: () => void): Command {
  const command = new ClearCommand({ owner, pass: Pass.OPAQUE });
  return Object.assign(command, { execute: call });
}
