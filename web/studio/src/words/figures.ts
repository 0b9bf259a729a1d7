// SPDX-License-Identifier: Apache-2.0

/** A figure of so many digits, as the program prints them. */
export function figure(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined) return "-";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : value < 0 ? "-∞" : "-";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e7 || size < 1e-4) return value.toExponential(digits - 1);
  const text = value.toPrecision(digits);
  return text.includes("e") ? String(Number(text)) : text;
}

export const DEGREES = 180 / Math.PI;

/** An angle in the turn from -180 to 180 degrees. */
export function inFirstTurn(degrees: number): number {
  return degrees - 360 * Math.ceil((degrees - 180) / 360);
}
