interface Window {
  /** Milliseconds of the processor that all threads of the browser have taken; there where `tellProcessorTime` made it. */
  readonly processorTime: () => Promise<number>;
}
