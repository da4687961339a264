/* The smallest program of somebody else, in C: a triangle, shown by the server in this process. */
#include <hl/hl.h>
#include <stdio.h>

int main(void) {
  HLcontext* context = hlCreateContext("inproc:");
  double primitives = 0;
  if (context == NULL) return puts(hlGetConnectError()), 1;
  hlMakeCurrent(context);
  hlBegin(HL_TRIANGLES);
  hlVertex3d(0, 0, 0);
  hlVertex3d(1, 0, 0);
  hlVertex3d(0, 1, 0);
  hlEnd();
  hlFinish();
  hlGetDoublev(HL_FRAME_PRIMITIVES, &primitives);
  printf("HL %s shows %.0f triangle\n", hlGetString(HL_VERSION), primitives);
  const HLenum error = hlGetError();
  hlDestroyContext(context);
  return error == HL_NO_ERROR && primitives == 1 ? 0 : 1;
}
