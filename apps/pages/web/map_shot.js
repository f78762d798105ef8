// The rows of a shot in one channel, on its map.
import {differenceColour, greyColour} from './colour_scale.js';
import {element} from './element.js';
import {kClipped, kStates, kUsed, unpack} from './map_data.js';
import {numberText} from './number_text.js';

const kBehind = [28, 30, 34];
const kUnused = [120, 120, 120];
const kClippedColour = [213, 0, 50];
const kLeftOut = [230, 159, 0];
const kObservedStep_percent = 0.01;
const kDifferenceStep = 0.01;

// In percent of the brightest row in use.
export class MapShot {
  constructor(stated, map, fullScale_percent, rows, observed, difference, state) {
    Object.assign(this, {stated, map, rows, state, fullScale_percent});
    this.observed = Float32Array.from(observed, v => v * kObservedStep_percent);
    this.difference = Float32Array.from(difference, v => v * kDifferenceStep * fullScale_percent);
  }
  static async unpack(data, stated) {
    const map = data.maps[stated.map];
    map.unpacked ??= unpack(map.rows, Int32Array, 3);
    return new MapShot(stated, map, data.full_scale_percent, await map.unpacked,
                    await unpack(stated.observed, Int16Array, 2),
                    await unpack(stated.difference, Int16Array, 2), await unpack(stated.state, Uint8Array, 1));
  }
  colour(panel, row) {
    if (this.state[row] !== kUsed) {
      if (panel !== 'observed') return kUnused;
      return this.state[row] === kClipped ? kClippedColour : kLeftOut;
    }
    if (panel === 'difference') return differenceColour(this.difference[row] / this.fullScale_percent);
    const model = panel === 'model' ? this.difference[row] : 0;
    return greyColour((this.observed[row] - model) / 100);
  }
  // A canvas of the map's size.
  picture(panel) {
    const {width, height} = this.map;
    const canvas = element('canvas', {width, height});
    const image = new ImageData(width, height);
    this.rows.forEach((row, i) => {
      image.data.set(row === 0 ? kBehind : this.colour(panel, row - 1), 4 * i);
      image.data[4 * i + 3] = 255;
    });
    canvas.getContext('2d').putImageData(image, 0, 0);
    return canvas;
  }
  // What is known of the place (x, y) of the map.
  text(x, y) {
    const {x0, y0, step, width} = this.map;
    const pixel = v => Math.floor(v) * step + Math.floor(step / 2);
    const place = `x ${x0 + pixel(x)} y ${y0 + pixel(y)} px: `;
    const row = this.rows[Math.floor(y) * width + Math.floor(x)] - 1;
    if (row < 0) return `${place}no patch`;
    if (this.state[row] !== kUsed) return `${place}patch ${row}, not used (${kStates[this.state[row]]})`;
    const [o, d] = [this.observed[row], this.difference[row]];
    return `${place}patch ${row}, observed ${numberText(o)} %, model ${numberText(o - d)} %, ` +
      `difference ${d > 0 ? '+' : ''}${numberText(d, 3)} %`;
  }
}
