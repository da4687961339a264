/* A paddle wheel that turns and pushes the hand: one object, called in every frame with another matrix.
 *
 *   05_moving_paddle [URL [SECONDS]] */
#include <hl/hl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WHEEL = 1, BLADES = 4 };

/* Blades are thin: both sides of a surface are touched, and nothing falls through one that moves. */
static void defineWheel(void) {
  hlNewObject(WHEEL);
  for (int blade = 0; blade < BLADES; ++blade) {
    hlPushMatrix();
    hlRotated(360.0 / BLADES * blade, 0, 0, 1);
    hlBegin(HL_QUADS);
    hlVertex3d(0, 0, -0.03);
    hlVertex3d(0.05, 0, -0.03);
    hlVertex3d(0.05, 0, 0.03);
    hlVertex3d(0, 0, 0.03);
    hlEnd();
    hlPopMatrix();
  }
  hlEndObject();
}

/* The hand gives way: between two blades it is carried around. */
static void printPush(void) {
  double force[3];
  int name = 0;
  hlGetDoublev(HL_FORCE, force);
  hlGetIntegerv(HL_TOUCHED_NAME, &name);
  if (name == WHEEL) printf("pushed: %+.2f N to the right, %+.2f N up\n", force[0], force[1]);
}

int main(int argc, char** argv) {
  const char* url = argc > 1 ? argv[1] : "inproc:";
  const double seconds = argc > 2 ? atof(argv[2]) : 10;
  HLcontext* context = hlCreateContext(url);
  if (context == NULL) {
    fprintf(stderr, "05_moving_paddle: %s\n", hlGetConnectError());
    return 2;
  }
  hlMakeCurrent(context);
  hlWorkspaced(0, 0.08, 0, 1);
  defineWheel();
  hlLoadName(WHEEL);
  for (int i = 0; i < 60 * seconds; ++i) {
    /* The server moves the wheel evenly from frame to frame, a thousand times a second. */
    hlLoadIdentity();
    hlRotated(-0.5 * i, 0, 0, 1);
    hlCallObject(WHEEL);
    hlFlush();
    /* Nobody holds the simulated device of inproc:, so the program does: it holds its hand into the wheel. */
    if (strncmp(url, "inproc:", 7) == 0) hlHandGoal3d(0, 0.048, 0);
    hlPoll();
    if (i % 15 == 0) printPush();
    usleep(16667);
  }

  const int failed = hlGetError() != HL_NO_ERROR;
  if (failed) fprintf(stderr, "05_moving_paddle: %s\n", hlGetString(HL_ERROR_STRING));
  hlDestroyContext(context);
  return failed;
}
