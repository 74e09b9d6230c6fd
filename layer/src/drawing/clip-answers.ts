import type { ClipSet, ClipVolumes, NodeClips, SourceSpace, Steps } from "../clips/index.js";
import type { NodeBounds } from "../octree/index.js";
import type { DrawnVertices } from "./drawn-vertices.js";
import type { FrameAllowance } from "./frame-allowance.js";

const WHOLE: NodeClips = { state: "in", count: 0, texels: [] };
const NOTHING: NodeClips = { state: "out", count: 0, texels: [] };

/** The volumes of a set at one time, and what they make of nodes as far as that was asked. */
interface Answers {
  /** What they were taken from; undefined: none. */
  readonly set: ClipSet | undefined;
  readonly revision: number;
  /** Undefined: everything stays. */
  readonly volumes: ClipVolumes | undefined;
  readonly nodes: WeakMap<DrawnVertices, NodeClips>;
}

/**
 * What a layer's volumes make of its nodes, worked out within the allowance of frames, most important nodes first.
 *
 * A change of the volumes shows all at once: until the new ones are compiled, and have been held against all nodes that
 * are drawn, the former ones hold for the whole picture. A node that comes anew is not drawn before the volumes that
 * hold were held against it, so no point is ever drawn that they cut. Before the first volumes hold, nothing is drawn.
 * While volumes are being prepared others wait: while a volume is dragged, each frame shows one of its recent positions.
 * Volumes that cannot be prepared are passed over: the former ones go on holding, and {@link takeFailure} tells why.
 */
export class ClipAnswers {
  #now: Answers | undefined;
  #next: Answers | undefined;
  #compiling:
    | { readonly set: ClipSet; readonly revision: number; readonly steps: Steps<ClipVolumes> }
    | undefined;
  /** The node that is being held against volumes, which several frames may take. */
  #forming:
    | { readonly answers: Answers; readonly node: DrawnVertices; readonly steps: Steps<NodeClips> }
    | undefined;
  /**
   * Answers to a traversal, which asks about the same spheres in every frame; outdated ones do for some frames. Volumes go
   * by their number here: spheres that nobody asks about any more must not keep former ones alive.
   */
  readonly #rejected = new WeakMap<NodeBounds, { readonly by: number; readonly rejected: boolean }>();
  readonly #numbers = new WeakMap<ClipVolumes, number>();
  #numbered = 0;
  #outdated = false;
  #rested = false;
  /** The volumes that could not be prepared, which are not tried again, and why as long as nobody was told. */
  #failed: Pick<Answers, "set" | "revision"> | undefined;
  #failure: unknown;
  /** Whether this frame found an answer to its traversal, and how often it had to do with an outdated one. */
  #found = false;
  #guesses = 0;

  /** Begins a frame: compiles volumes that are new, as far as the frame allows. */
  follow(clips: ClipSet | undefined, space: SourceSpace, allowance: FrameAllowance): void {
    this.#found = false;
    this.#guesses = 0;
    const set = clips && clips.size > 0 ? clips : undefined;
    const revision = set?.revision ?? 0;
    if (this.#rested && !isOf(this.#now, set, revision)) {
      this.#now = undefined;
      this.#next = undefined;
      this.#compiling = undefined;
    }
    this.#rested = false;
    if (!isOf(this.#failed, set, revision)) this.#failed = undefined;
    if (!this.#next && !this.#compiling && !this.#failed && !isOf(this.#now, set, revision)) {
      if (set) this.#compiling = { set, revision, steps: set.overInSteps(space) };
      else this.#take({ set, revision, volumes: undefined, nodes: new WeakMap() });
    }
    this.#compile(allowance);
    const known = isOf(this.#next ?? this.#now, set, revision) || isOf(this.#failed, set, revision);
    this.#outdated = !known;
  }

  /** Whether nothing can be drawn: the volumes cannot be prepared, and none held before. */
  get blocked(): boolean {
    return this.#failed !== undefined && this.#now === undefined;
  }

  /** Why volumes could not be prepared or held against a node; each failure is given once. */
  takeFailure(): unknown {
    const failure = this.#failure;
    this.#failure = undefined;
    return failure;
  }

  /** The volumes that hold now or, where there are some, are to hold next; a frame's effects follow from these. */
  get volumes(): ClipVolumes | undefined {
    return (this.#next ?? this.#now)?.volumes;
  }

  /** The volumes that hold now. */
  get held(): ClipVolumes | undefined {
    return this.#now?.volumes;
  }

  /** Whether a node is cut wholly; asked by a traversal. Beyond what a frame allows, an outdated answer has to do. */
  rejects(bounds: NodeBounds, allowance: FrameAllowance): boolean {
    const volumes = this.#now?.volumes;
    if (!volumes) return false;
    const known = this.#rejected.get(bounds);
    const by = this.#numberOf(volumes);
    if (known?.by === by) return known.rejected;
    // One answer in each frame is found whatever it takes, so that all are in the end.
    if (this.#found && !allowance.left) {
      this.#guesses++;
      return known?.rejected ?? false;
    }
    this.#found = true;
    const rejected = this.#rejects(volumes, bounds);
    this.#rejected.set(bounds, { by, rejected });
    return rejected;
  }

  /** What is left of a node by the volumes that hold; undefined where it has to wait. */
  of(node: DrawnVertices): NodeClips | undefined {
    if (!this.#now) return undefined;
    return this.#now.volumes ? this.#now.nodes.get(node) : WHOLE;
  }

  /**
   * Holds volumes against nodes, as far as the frame allows: those that hold, then those that are to hold next.
   * @param nodes undefined: not here yet
   * @returns nodes that have to wait
   */
  form(nodes: readonly (DrawnVertices | undefined)[], allowance: FrameAllowance): number {
    return this.#answer(this.#now, nodes, allowance) || this.#answer(this.#next, nodes, allowance);
  }

  /** Lets the next volumes hold; called once all nodes have been held against them. */
  advance(): void {
    if (!this.#next) return;
    this.#now = this.#next;
    this.#next = undefined;
    // The traversal of this frame went by the former ones.
    this.#guesses++;
  }

  /** Nothing is drawn for now: there will be no former picture to keep. */
  rest(): void {
    this.#rested = true;
  }

  /** Whether what this frame shows is not yet what the volumes asked for make of it. */
  get pending(): boolean {
    return this.#outdated || this.#next !== undefined || this.#guesses > 0;
  }

  #take(answers: Answers): void {
    if (this.#now || answers.volumes) this.#next = answers;
    else this.#now = answers;
  }

  #compile(allowance: FrameAllowance): void {
    if (!this.#compiling) return;
    const { set, revision, steps } = this.#compiling;
    try {
      while (allowance.grants()) {
        const { done, value } = steps.next();
        if (!done) continue;
        this.#compiling = undefined;
        this.#take({ set, revision, volumes: value, nodes: new WeakMap() });
        return;
      }
    } catch (thrown) {
      this.#compiling = undefined;
      this.#passOver({ set, revision }, thrown);
    }
  }

  #passOver(failed: Pick<Answers, "set" | "revision">, thrown: unknown): void {
    this.#failed = failed;
    this.#failure ??= thrown;
  }

  #numberOf(volumes: ClipVolumes): number {
    const number = this.#numbers.get(volumes) ?? ++this.#numbered;
    this.#numbers.set(volumes, number);
    return number;
  }

  #rejects(volumes: ClipVolumes, bounds: NodeBounds): boolean {
    try {
      return volumes.rejects(bounds);
    } catch (thrown) {
      this.#failure ??= thrown;
      return false;
    }
  }

  #answer(
    answers: Answers | undefined,
    nodes: readonly (DrawnVertices | undefined)[],
    allowance: FrameAllowance,
  ): number {
    if (!answers?.volumes) return 0;
    const open: DrawnVertices[] = [];
    for (const node of nodes) if (node && !answers.nodes.has(node)) open.push(node);
    // What was begun is finished first, whatever the order is now.
    const begun = open.findIndex((node) => answers === this.#forming?.answers && node === this.#forming.node);
    if (begun > 0) open.unshift(...open.splice(begun, 1));
    const stopped = open.findIndex((node) => !this.#form(answers, node, allowance));
    return stopped < 0 ? 0 : open.length - stopped;
  }

  /** @returns whether it is done */
  #form(answers: Answers, node: DrawnVertices, allowance: FrameAllowance): boolean {
    try {
      return this.#formInSteps(answers, node, allowance);
    } catch (thrown) {
      this.#forming = undefined;
      if (answers === this.#next) {
        this.#next = undefined;
        this.#passOver(answers, thrown);
      } else {
        // Nobody knows what they leave of the node: none of it is drawn, so that nothing shows that they cut.
        answers.nodes.set(node, NOTHING);
        this.#failure ??= thrown;
      }
      return true;
    }
  }

  #formInSteps(answers: Answers, node: DrawnVertices, allowance: FrameAllowance): boolean {
    while (allowance.grants()) {
      if (this.#forming?.answers !== answers || this.#forming.node !== node) {
        this.#forming = { answers, node, steps: answers.volumes!.forNodeInSteps(node.onGlobe ?? node) };
      }
      const { done, value } = this.#forming.steps.next();
      if (!done) continue;
      this.#forming = undefined;
      answers.nodes.set(node, value);
      return true;
    }
    return false;
  }
}

function isOf(
  answers: Pick<Answers, "set" | "revision"> | undefined,
  set: ClipSet | undefined,
  revision: number,
): boolean {
  return answers !== undefined && answers.set === set && answers.revision === revision;
}
