// The quantities of surfaces, as the engine lists them (hlWebQuantities). Pure.

import type { MessageInitShape } from "@bufbuild/protobuf";
import type { QuantityInfoSchema, Surfaces } from "../gen/hl_pb";

/** Fields of Surfaces that are numbers. */
export type NumberField = {
  [Field in keyof Surfaces]-?: NonNullable<Surfaces[Field]> extends number ? Field : never;
}[keyof Surfaces];

export interface EngineQuantity extends Exclude<MessageInitShape<typeof QuantityInfoSchema>, { $typeName: string }> {
  readonly field: NumberField;
  readonly usual: number;
}

/** "viscosity_Ns_m" as JSON has it: "viscosityNsM". */
function jsonName(field: string): string {
  return field.replace(/_(.)/g, (_, next: string) => next.toUpperCase());
}

/** In the engine's order: number i is that of _hlWebSurface(i). */
export function parseQuantities(lines: string): EngineQuantity[] {
  return lines.split("\n").filter((line) => line !== "").map((line) => {
    const [field, name, unit, usual, otherwise, words] = line.split("\t") as [
      string, string, string, string, string, string];
    const json = jsonName(field) as NumberField;
    return { field: json, name, unit, usual: Number(usual), otherwise: Number(otherwise), words };
  });
}
