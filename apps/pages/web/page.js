// What makes a page's figures live. Each stands in an element with data-widget="KIND", beside the JSON
// that it is drawn from.
import uplotStyle from 'uplot/dist/uPlot.min.css';
import pageStyle from './page.css';
import {mountPlot} from './plot.js';
import {mountMaps} from './residual_maps.js';
import {mountRig} from './rig_view.js';

const kinds = {maps: mountMaps, plot: mountPlot, rig: mountRig};

const style = document.createElement('style');
style.textContent = uplotStyle + pageStyle;
document.head.append(style);
for (const host of document.querySelectorAll('[data-widget]')) {
  kinds[host.dataset.widget](host, JSON.parse(host.querySelector('script').textContent));
}
