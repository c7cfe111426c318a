// Types that the console's modules state in their comments; nothing of it is served.

/** Longitude and latitude, or x and y. */
type Point = [number, number];

/** West, south, east, north; or left, top, right, bottom. */
type Bounds = [number, number, number, number];

/** From and until, in seconds or rows. */
type Span = [number, number];

/** The parts of a request's `options` that the console asks for. */
interface Options {
  time_limit?: number;
  search_iterations?: number;
  decoding?: 'greedy' | 'sample';
  num_samples?: number;
}

interface Window {
  /** Leaflet, which index.html loads. */
  L: any;
  /** The curves, loaded when they are first needed. */
  uPlot: any;
}
