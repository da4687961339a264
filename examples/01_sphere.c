/* A sphere to touch: a context, vertices with normals, one frame, and what the finger feels.
 *
 *   01_sphere [URL [SECONDS]]
 *
 * URL: inproc: (a server inside this program; the default), hl://HOST[:PORT] or hls://HOST[:PORT]. */
#include <hl/hl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double kRadius = 0.04; /* m */
static const double kPi = 3.14159265358979;

static void vertexAt(double latitude, double longitude) {
  const double x = cos(latitude) * sin(longitude), y = sin(latitude), z = cos(latitude) * cos(longitude);
  hlNormal3d(x, y, z);
  hlVertex3d(kRadius * x, kRadius * y, kRadius * z);
}

static void drawSphere(int rings, int slices) {
  for (int ring = 0; ring < rings; ++ring) {
    const double south = kPi * (ring - 0.5 * rings) / rings, north = south + kPi / rings;
    hlBegin(HL_QUAD_STRIP);
    for (int slice = 0; slice <= slices; ++slice) {
      vertexAt(north, 2 * kPi * slice / slices);
      vertexAt(south, 2 * kPi * slice / slices);
    }
    hlEnd();
  }
}

static void onTouch(const HLevent* event, void* user) {
  (void)user;
  printf("touch: %s name %u at %.3f %.3f %.3f\n", event->kind == HL_EVENT_TOUCH ? "on" : "off", event->name,
         event->position[0], event->position[1], event->position[2]);
}

/* Nobody holds the simulated device of inproc:, so the program moves its hand: it strokes the top of the sphere and
 * lifts off every four seconds. */
static void moveHand(double t) {
  const double height = fmod(t, 4) < 3 ? kRadius - 0.005 : kRadius + 0.02;
  hlHandGoal3d(0.015 * sin(t), height, 0.015 * cos(t));
}

int main(int argc, char** argv) {
  const char* url = argc > 1 ? argv[1] : "inproc:";
  const double seconds = argc > 2 ? atof(argv[2]) : 10;
  HLcontext* context = hlCreateContext(url);
  if (context == NULL) {
    fprintf(stderr, "01_sphere: %s\n", hlGetConnectError());
    return 2;
  }
  hlMakeCurrent(context);
  hlEventFunc(HL_EVENT_TOUCH, onTouch, NULL);
  hlEventFunc(HL_EVENT_UNTOUCH, onTouch, NULL);

  /* The middle of the device's reach, where a hand begins, is 30 mm above the sphere; the scale is 1 to 1. */
  hlWorkspaced(0, kRadius + 0.03, 0, 1);
  hlLoadName(7);
  drawSphere(24, 48);
  hlFinish();

  for (int i = 0; i < 60 * seconds; ++i) {
    if (strncmp(url, "inproc:", 7) == 0) moveHand(i / 60.0);
    hlPoll();
    if (i % 60 == 59) {
      double force[3];
      hlGetDoublev(HL_FORCE, force);
      printf("force: %.2f N\n", sqrt(force[0] * force[0] + force[1] * force[1] + force[2] * force[2]));
    }
    usleep(16667);
  }

  const int failed = hlGetError() != HL_NO_ERROR;
  if (failed) fprintf(stderr, "01_sphere: %s\n", hlGetString(HL_ERROR_STRING));
  hlDestroyContext(context);
  return failed;
}
