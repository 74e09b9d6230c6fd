import { expect, it } from "vitest";
import { dated } from "./epoch.js";
import { pipelineWords, splitPipeline } from "./step-text.js";

const HELMERT =
  "+proj=helmert +x=0.5 +rx=0.1 +dx=0.02 +drx=0.001 +ds=0.1 +dz=0 +t_epoch=2020 +convention=coordinate_frame";
const words = (text: string) => {
  const { steps, undated } = dated(splitPipeline(text));
  return { text: pipelineWords(steps).join(" "), undated };
};

it("parameters of a Helmert transformation grow by their rates up to the epoch that is set", () => {
  const { text, undated } = words(`+proj=pipeline +step +proj=set +v_4=2022.5 +step ${HELMERT}`);
  expect(text).not.toMatch(/set|t_epoch|\+d/);
  expect(undated).toBe(false);
  const number = (key: string) => Number(new RegExp(`\\+${key}=(\\S+)`).exec(text)?.[1]);
  expect(number("x")).toBeCloseTo(0.55, 12);
  expect(number("rx")).toBeCloseTo(0.1025, 12);
  expect(number("s")).toBeCloseTo(0.25, 12);
  expect(text).toContain("+convention=coordinate_frame");
});

it("they stay what they are without an epoch, which is told where a rate is not zero", () => {
  expect(words(`+proj=pipeline +step ${HELMERT}`)).toEqual({
    text: "+proj=pipeline +step +proj=helmert +x=0.5 +rx=0.1 +convention=coordinate_frame",
    undated: true,
  });
  expect(words("+proj=pipeline +step +proj=helmert +x=1 +dx=0 +t_epoch=2000").undated).toBe(false);
});

it("an epoch holds for the steps behind it alone, and other steps and settings stay", () => {
  expect(words(`+proj=pipeline +step ${HELMERT} +step +proj=set +v_4=2022`).undated).toBe(true);
  const other = "+proj=pipeline +step +proj=set +v_3=0 +step +proj=deformation +grids=a.tif +t_epoch=2000";
  expect(words(other)).toEqual({ text: other, undated: false });
});
