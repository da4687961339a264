// A message of the server as bytes.

import { create, toBinary } from "@bufbuild/protobuf";
import { ServerMessageSchema, type ServerMessage } from "../gen/hl_pb";

type Body = NonNullable<NonNullable<Parameters<typeof create<typeof ServerMessageSchema>>[1]>["body"]>;

export function encode(body: Body): Uint8Array<ArrayBuffer> {
  const message: ServerMessage = create(ServerMessageSchema, { body });
  return toBinary(ServerMessageSchema, message) as Uint8Array<ArrayBuffer>;
}
