// The smallest program of somebody else, in C++: an object, shown by the server in this process; and an error that
// comes as an exception, also from a server that is not there.
#include <cstdio>
#include <hl/hl.hpp>

int main() {
  try {
    hl::Context nobody("hl://127.0.0.1:1");
    return 1;
  } catch (const hl::CallError& error) {
    std::printf("as it should be: %s\n", error.what());
  }
  hl::Context context;
  const HLuint triangle = hl::genObject();
  {
    const hl::ObjectScope object(triangle);
    const hl::PrimitiveScope primitives(HL_TRIANGLES);
    hlVertex3d(0, 0, 0);
    hlVertex3d(1, 0, 0);
    hlVertex3d(0, 1, 0);
  }
  hlCallObject(triangle);
  hlFinish();
  hl::check();
  std::printf("%.0f triangle\n", hl::get(HL_FRAME_PRIMITIVES));
  return hl::get(HL_FRAME_PRIMITIVES) == 1 ? 0 : 1;
}
