/** A bar that tells lengths, for planar and geographic maps alike. */

import { leaflet } from '../libraries.js';

const L = leaflet();
const MOST_PIXELS = 110;

export const ScaleBar = L.Control.extend({
  options: { position: 'bottomleft', metresPerUnit: null },

  onAdd(map) {
    this.bar = L.DomUtil.create('div', 'scale-bar');
    map.on('move zoomend resize', this.update, this);
    this.update();
    return this.bar;
  },

  onRemove(map) {
    map.off('move zoomend resize', this.update, this);
  },

  update() {
    const map = this._map;
    const { y } = map.getSize();
    const [left, right] = [0, MOST_PIXELS].map((x) => map.containerPointToLatLng([x, y / 2]));
    const unit = this.options.metresPerUnit;
    const metres =
      unit === null ? map.distance(left, right) : Math.abs(right.lng - left.lng) * unit;
    if (!(metres > 0) || !Number.isFinite(metres)) return;
    const round = roundDown(metres);
    this.bar.style.width = `${(MOST_PIXELS * round) / metres}px`;
    this.bar.textContent = round >= 1000 ? `${round / 1000} km` : `${round} m`;
  },
});

function roundDown(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [5, 2, 1].find((step) => step * power <= value) * power;
}
