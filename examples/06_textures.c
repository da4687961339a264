/* Four tiles with haptic textures: images that say what a surface feels like from place to place.
 *
 *   06_textures [URL [SECONDS]] */
#include <hl/hl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SIZE = 32 };
static const double kTile = 0.04; /* m */
static const char* const kNames[] = {"nothing", "soft squares", "rough lines", "round bumps", "bumps in honey"};

/* Images: a checker, slanted stripes, and waves in both directions. */
static float checker(int u, int v) { return (u / (SIZE / 2) + v / (SIZE / 2)) % 2 == 0 ? 0.0F : 1.0F; }
static float stripes(int u, int v) { return (u + v) / (SIZE / 2) % 2 == 0 ? 0.0F : 1.0F; }
static float waves(int u, int v) { return 0.5F - 0.25F * (cosf(6.2832F * u / SIZE) + cosf(6.2832F * v / SIZE)); }

static HLuint makeTexture(float (*image)(int u, int v)) {
  float texels[SIZE * SIZE];
  HLuint texture = 0;
  for (int i = 0; i < SIZE * SIZE; ++i) texels[i] = image(i % SIZE, i / SIZE);
  hlGenTextures(1, &texture);
  hlBindTexture(HL_TEXTURE_2D, texture);
  hlTexImage2D(HL_TEXTURE_2D, 0, HL_LUMINANCE, SIZE, SIZE, 0, HL_LUMINANCE, HL_FLOAT, texels);
  return texture;
}

/* From now on `texture` says what `quantity` is, from `low` where it is black to `high` where it is white. */
static void useTexture(HLenum unit, HLuint texture, HLenum quantity, float low, float high) {
  hlActiveTexture(unit);
  hlBindTexture(HL_TEXTURE_2D, texture);
  hlTexEnvi(HL_TEXTURE_ENV, HL_TEXTURE_QUANTITY, (HLint)quantity);
  hlTexEnvf(HL_TEXTURE_ENV, HL_TEXTURE_LOW, low);
  hlTexEnvf(HL_TEXTURE_ENV, HL_TEXTURE_HIGH, high);
  hlEnable(HL_TEXTURE_2D);
}

static void drawTile(HLuint name, double x) {
  static const double kCorners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const double repeats = 5;
  hlLoadName(name);
  hlBegin(HL_QUADS);
  for (int i = 0; i < 4; ++i) {
    hlTexCoord2d(repeats * kCorners[i][0], repeats * kCorners[i][1]);
    hlVertex3d(x + kTile * kCorners[i][0], 0, kTile * (0.5 - kCorners[i][1]));
  }
  hlEnd();
}

static void drawTiles(void) {
  const HLuint squares = makeTexture(checker), lines = makeTexture(stripes), bumps = makeTexture(waves);
  useTexture(HL_TEXTURE0, squares, HL_STIFFNESS, 0.2F, 1);
  drawTile(1, -2 * kTile);
  useTexture(HL_TEXTURE0, lines, HL_DYNAMIC_FRICTION, 0.1F, 0.8F);
  drawTile(2, -kTile);
  useTexture(HL_TEXTURE0, bumps, HL_HEIGHT, 0, 0.0003F);
  drawTile(3, 0);
  useTexture(HL_TEXTURE0 + 1, squares, HL_VISCOSITY, 0, 4); /* with unit 0: two quantities at once */
  drawTile(4, kTile);
}

int main(int argc, char** argv) {
  const char* url = argc > 1 ? argv[1] : "inproc:";
  const double seconds = argc > 2 ? atof(argv[2]) : 20;
  HLcontext* context = hlCreateContext(url);
  if (context == NULL) {
    fprintf(stderr, "06_textures: %s\n", hlGetConnectError());
    return 2;
  }
  hlMakeCurrent(context);
  hlWorkspaced(0, 0.03, 0, 1);
  drawTiles();
  hlFinish();

  int before = 0;
  for (int i = 0; i < 60 * seconds; ++i) {
    /* Nobody holds the simulated device of inproc:, so the program moves its hand across the tiles. */
    if (strncmp(url, "inproc:", 7) == 0) hlHandGoal3d(-0.07 * cos(0.6 * i / 60), -0.006, 0.01 * sin(i / 60.0));
    hlPoll();
    int name = 0;
    HLcontact contact;
    hlGetIntegerv(HL_TOUCHED_NAME, &name);
    if (name != before && name <= 4) printf("touching: %s\n", kNames[name]);
    if (i % 30 == 0 && hlGetContacts(1, &contact) == 1) printf("stiffness here: %.2f\n", contact.stiffness);
    before = name;
    usleep(16667);
  }

  const int failed = hlGetError() != HL_NO_ERROR;
  if (failed) fprintf(stderr, "06_textures: %s\n", hlGetString(HL_ERROR_STRING));
  hlDestroyContext(context);
  return failed;
}
