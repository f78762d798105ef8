// Numbers as text.

// With four significant digits, and a power of ten where that is shorter: 0.001234, 1.2 × 10⁻⁷.
export function numberText(value, digits = 4) {
  if (value === null || !Number.isFinite(value)) return '–';
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e7)) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
    return `${Number(mantissa)} × 10${superscript(Number(exponent))}`.replace('-', '−');
  }
  return String(Number(value.toPrecision(digits))).replace('-', '−');
}

export function superscript(integer) {
  return [...String(integer)].map(c => c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[c]).join('');
}

// The label of an axis without its unit, and its unit: "r [1/mm^2]" -> ["r", "1/mm²"].
export function labelAndUnit(label) {
  const match = /^(.*?)\s*\[(.*)\]$/.exec(label);
  const pretty = text => text.replace(/\^(-?\d)/g, (_, n) => superscript(Number(n)));
  return match ? [match[1], pretty(match[2])] : [label, ''];
}
