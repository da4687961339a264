// The script of 11_web_client.html: a square, what happens to it, and a hand that follows the pointer.
const square = document.getElementById("square");
const server = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/hl`);
const send = (message) => server.send(JSON.stringify(message));
const say = (text) => {
  document.getElementById("touched").textContent = text;
  console.log(text);
};

server.onopen = () => {
  send({ open: { protocol_version: 1, client_name: "11_web_client", master: true, state_rate_Hz: 60 } });
  const corners = { vertices: [-.05, 0, -.05, .05, 0, -.05, .05, 0, .05, -.05, 0, .05], polygons: [{ vertices: [0, 3, 2, 1] }] };
  send({ frame: { number: 1, world: { items: [{ primitives: corners, name: 7 }] } } });
};
server.onmessage = ({ data }) => {
  const { state, event, frame_shown, refusal } = JSON.parse(data);
  if (frame_shown) say(`shown: ${frame_shown.primitives} triangles`);
  if (refusal) say(`refused: ${refusal.text}`);
  if (event && event.kind !== "MOTION") say(`${event.kind === "TOUCH" ? "touching" : "left"}: name ${event.name}`);
  if (!state || !state.proxy) return;
  const proxy = document.getElementById("proxy");
  proxy.setAttribute("cx", state.proxy.x);
  proxy.setAttribute("cy", state.proxy.z);
};
server.onclose = ({ code, reason }) => say(`ended: ${code} ${reason}`);

square.style.touchAction = "none";
square.onpointermove = (move) => {
  if (move.buttons === 0) return;
  const x = (move.offsetX / 400 - 0.5) * 0.1, z = (move.offsetY / 400 - 0.5) * 0.1;
  send({ device: { hand_goal: { position: { x, y: -0.005, z } } } });
};
