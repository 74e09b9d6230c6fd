/** A stage of some work, and the share of the time that it takes, by experience. */
export interface Stage {
  readonly stage: string;
  readonly share: number;
  readonly ofPdal?: true;
}

/** The stages of a conversion in their order. */
const CONVERSION: readonly Stage[] = [
  { stage: "inspect", share: 0.4, ofPdal: true },
  { stage: "pdal", share: 0.6, ofPdal: true },
  { stage: "read", share: 0.55 },
  { stage: "build", share: 0.4 },
  { stage: "write", share: 0.05 },
];

/** Share of the whole, and seconds, after which a forecast is more than a guess. */
const FORECAST_FROM = { share: 0.02, seconds: 1 };

/** How fast a conversion is, and how long it will take. */
export interface Pace {
  /** Points per second of the stage; 0 as long as none is done. */
  readonly rate: number;
  /** Seconds to the end of the whole; null as long as nothing can be said. */
  readonly eta: number | null;
  /** Share of the whole that is done, 0 to 1. */
  readonly overall: number;
}

/** Follows the stages of one conversion, or of other work. */
export function createPace(
  now: () => number = () => performance.now(),
  stages: readonly Stage[] = CONVERSION,
): {
  advance(stage: string, done: number, total: number): Pace;
} {
  const began = now();
  let stage = "";
  let stageBegan = began;
  let withPdal = false;
  return {
    advance(current, done, total) {
      if (current !== stage) {
        stage = current;
        stageBegan = now();
      }
      withPdal ||= stages.some((step) => step.stage === current && step.ofPdal);
      const seconds = (now() - stageBegan) / 1000;
      const rate = seconds > 0 ? Math.round(done / seconds) : 0;
      const share = overall(stages, current, done, total, withPdal);
      const elapsed = (now() - began) / 1000;
      const known = share >= FORECAST_FROM.share && elapsed >= FORECAST_FROM.seconds;
      const eta = known ? Math.max(0, Math.round((elapsed * (1 - share)) / share)) : null;
      return { rate, eta, overall: share };
    },
  };
}

/** Share of the whole that is done, 0 to 1. */
function overall(
  all: readonly Stage[],
  stage: string,
  done: number,
  total: number,
  withPdal: boolean,
): number {
  const stages = all.filter((step) => withPdal || !step.ofPdal);
  const whole = stages.reduce((sum, { share }) => sum + share, 0);
  let before = 0;
  for (const step of stages) {
    if (step.stage === stage)
      return (before + step.share * (total > 0 ? Math.min(1, done / total) : 1)) / whole;
    before += step.share;
  }
  return 0;
}
