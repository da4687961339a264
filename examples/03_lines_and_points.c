/* What has no surface can be touched too: the strings of a harp are lines, the word beside it is Braille, of points.
 *
 *   03_lines_and_points [URL [SECONDS]] */
#include <hl/hl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { STRINGS = 16, FRAME = 100, BRAILLE = 101 };

/* Sixteen strings, each with its name, that a finger of 2 mm radius can strum but not fall through. */
static void drawHarp(void) {
  for (int i = 0; i < STRINGS; ++i) {
    const double x = 0.004 * (i - STRINGS);
    hlLoadName(1 + i);
    hlBegin(HL_LINES);
    hlVertex3d(x, 0, -0.04);
    hlVertex3d(x, 0, 0.04 - 0.003 * i);
    hlEnd();
  }
  hlLoadName(FRAME);
  hlBegin(HL_LINE_LOOP);
  hlVertex3d(-0.068, 0, -0.04);
  hlVertex3d(0, 0, -0.04);
  hlVertex3d(0, 0, -0.01);
  hlVertex3d(-0.068, 0, 0.042);
  hlEnd();
}

/* h and l: which of the six dots of a Braille cell are there, column by column. The dots are 2.5 mm apart. */
static void drawBraille(void) {
  static const char* const kCells[] = {"110010", "111000"};
  hlLoadName(BRAILLE);
  hlBegin(HL_POINTS);
  for (int cell = 0; cell < 2; ++cell) {
    for (int dot = 0; dot < 6; ++dot) {
      if (kCells[cell][dot] == '1')
        hlVertex3d(0.012 + 0.008 * cell + 0.0025 * (dot / 3), 0, 0.0025 * (dot % 3) - 0.0025);
    }
  }
  hlEnd();
}

/* Nobody holds the simulated device of inproc:, so the program moves its hand: it strums, then it reads. */
static void moveHand(double t) { hlHandGoal3d(-0.025 - 0.045 * cos(0.7 * t), -0.002, 0); }

int main(int argc, char** argv) {
  const char* url = argc > 1 ? argv[1] : "inproc:";
  const double seconds = argc > 2 ? atof(argv[2]) : 10;
  HLcontext* context = hlCreateContext(url);
  if (context == NULL) {
    fprintf(stderr, "03_lines_and_points: %s\n", hlGetConnectError());
    return 2;
  }
  hlMakeCurrent(context);
  hlWorkspaced(-0.02, 0.03, 0, 1);
  hlProxyd(HL_PROXY_RADIUS, 0.0025); /* more than half the distance of two strings */
  hlMaterialf(HL_STATIC_FRICTION, 0.3F);
  hlMaterialf(HL_DYNAMIC_FRICTION, 0.2F);
  drawHarp();
  drawBraille();
  hlFinish();

  int before = 0;
  for (int i = 0; i < 60 * seconds; ++i) {
    if (strncmp(url, "inproc:", 7) == 0) moveHand(i / 60.0);
    hlPoll();
    int name = 0;
    hlGetIntegerv(HL_TOUCHED_NAME, &name);
    if (name != before && name >= 1 && name <= STRINGS) printf("touching: string %d\n", name);
    if (name != before && name == FRAME) printf("touching: the frame\n");
    if (name != before && name == BRAILLE) printf("touching: the dots\n");
    before = name;
    usleep(16667);
  }

  const int failed = hlGetError() != HL_NO_ERROR;
  if (failed) fprintf(stderr, "03_lines_and_points: %s\n", hlGetString(HL_ERROR_STRING));
  hlDestroyContext(context);
  return failed;
}
