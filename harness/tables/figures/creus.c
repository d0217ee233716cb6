// Figures of C. Creus, Real-time realistic rain rendering, 2010, chapters 4 and 5. The city
// replaces the thesis's statue and its city.
#include "harness/tables/figures/figures.h"

// The view from outside on rain thin enough to show each drop.
#define OUTSIDE                                                                                    \
    "look=thesis city=small atlas=small lights=0 overlay=on depth_map_px=512 cull=exact "
// The whole rain space, as if the observer saw all of it.
#define WHOLE "limits=off packets=world blocks=all local_height_m=230 drops_m2_s=0.02 "
// An observer above the roofs, where the whole local space is visible.
#define ABOVE                                                                                      \
    "camera=free eye_x_m=-40 eye_y_m=110 eye_z_m=60 target_x_m=60 target_y_m=95 target_z_m=-60 "   \
    "local_height_m=70 culling_radius_m=55 drops_m2_s=0.6 "
#define TESTED "look=thesis "

enum { LEFT_MAP_PX = 6 };
static const float left_map[LEFT_MAP_PX * LEFT_MAP_PX] = {
    0,    0,    0,    0,    0,    0,    //
    0,    0.1f, 0.2f, 0.3f, 0.1f, 0,    //
    0.1f, 0.3f, 0.6f, 1,    0.5f, 0,    //
    0.2f, 0.5f, 1,    1,    0.6f, 0.1f, //
    0.1f, 0.3f, 0.5f, 0.8f, 0.3f, 0,    //
    0,    0,    0.1f, 0.2f, 0,    0,    //
};

static const float even_map[1] = {1};

static const char lamp[] =
    "{\"lights\": [{\"type\": \"spot\", \"position_m\": [-3.2, 6, 81], \"direction\": [0, -1, 0],\n"
    "  \"colour\": [1, 0.9, 0.7], \"intensity\": 60, \"inner_deg\": 25, \"outer_deg\": 33}],\n"
    " \"sky\": {\"colour\": [0.05, 0.055, 0.07]}}\n";

// A sun beyond the picture's top right corner.
static const char side_sun[] =
    "{\"lights\": [{\"type\": \"sun\", \"direction\": [-0.62, -0.5, 0.6],\n"
    "  \"colour\": [0.8, 0.75, 0.65]}],\n"
    " \"sky\": {\"colour\": [0.3, 0.33, 0.36]}}\n";

const struct rg_figure rg_figures_creus[] = {
    {.id = "creus-4.1",
     .technique = "streaks",
     .settings = OUTSIDE WHOLE "outside=space outside_map=density",
     .frame = 30,
     .caption = "The model of the rain. Drops fall through the rain space, the grey box; each has "
                "the colour of its height, blue at the top and red at the ground. How many there "
                "are where says the density map, which lies over the box and stands in the corner; "
                "what each hits says the depth map below it.",
     .printed = "Rain simulation model basic scheme."},
    {.id = "creus-4.3",
     .technique = "streaks",
     .settings = OUTSIDE WHOLE "outside=frustum outside_rise_deg=10 drops_m2_s=0.003",
     .frame = 30,
     .parameter = "density_map",
     .ending = ".exr",
     .greys = even_map,
     .side_px = 1,
     .caption =
         "The rain space of a perspective camera: its frustum, in grey. Drops fall away from "
         "that camera, each in its own direction, and all advance the same distance: in the "
         "middle they reach the ground, and towards the sides they end above it. Corner: the "
         "depth map, as that camera sees the city.",
     .printed = "Rain space with a perspective frustum."},
    {.id = "creus-4.4",
     .technique = "streaks",
     .settings = OUTSIDE ABOVE "outside=space packets=world",
     .frame = 30,
     .caption = "The spaces. Grey: the rain space. Green: the local top and the local ground, half "
                "way between which the observer is. Red: the prism of the culling radius. Blue: "
                "where both meet, which is where it rains.",
     .printed = "Rain simulation model subspaces."},
    {.id = "creus-4.5",
     .technique = "streaks",
     .settings =
         TESTED "overlay=on camera=first far_layers=0 local_height_m=2.5 culling_radius_m=6 "
                "streak_gain=6",
     .frame = 30,
     .caption = "Too small a space: it rains within the blue box alone, so that rain ends at its "
                "top, at its ground and a few metres ahead. Red: the prism of the culling radius. "
                "Corner: the depth map.",
     .printed = "Visualization errors caused by too narrow simulation volume."},
    {.id = "creus-4.10",
     .technique = "streaks",
     .settings = OUTSIDE WHOLE "outside=space outside_map=depth drops=off splashes=off",
     .frame = 30,
     .caption = "The camera that defines the rain space looks straight down: the grey box is its "
                "frustum, from the top to the ground. Its picture, the depth map, lies on the top.",
     .printed = "Camera used to define the rain space."},
    {.id = "creus-4.11a",
     .technique = "streaks",
     .settings = OUTSIDE WHOLE "outside=space outside_map=density packets=kd packet_size=200",
     .frame = 30,
     .parameter = "density_map",
     .ending = ".exr",
     .greys = left_map,
     .side_px = LEFT_MAP_PX,
     .caption = "Packets of at most 200 particles by the kd-tree, for a density map that is denser "
                "on one side: where there is little rain, packets are large.",
     .printed = "Tree packet approach."},
    {.id = "creus-4.11b",
     .technique = "streaks",
     .settings = OUTSIDE WHOLE "outside=space outside_map=density packets=quad packet_size=200",
     .frame = 30,
     .caption = "The same by the quad-tree, for the round gradient.",
     .printed = "Tree packet approach."},
    {.id = "creus-4.12",
     .technique = "streaks",
     .settings = OUTSIDE ABOVE "outside=space packets=grid packet_size=2500",
     .frame = 30,
     .caption = "Packets by the regular grid, in purple on the top plane.",
     .printed = "Particle bucket for the grid packet approach."},
    {.id = "creus-4.13a",
     .technique = "streaks",
     .settings = OUTSIDE ABOVE "outside=volume packets=world",
     .frame = 30,
     .caption = "The volume around an observer at a height of 110 m.",
     .printed = "Drops' height correction in two different frames."},
    {.id = "creus-4.13b",
     .technique = "streaks",
     .settings = OUTSIDE ABOVE "outside=volume packets=world eye_y_m=120 target_y_m=105",
     .frame = 30,
     .caption = "The observer stands 10 m higher, and with it the local space. Drops stay where "
                "they are; those that the local ground has left behind come in again at the local "
                "top. The picture has risen as well.",
     .printed = "Drops' height correction in two different frames."},
    {.id = "creus-4.14",
     .technique = "streaks",
     .settings = OUTSIDE ABOVE "outside=space packets=quad packet_size=2500",
     .frame = 30,
     .caption = "Which packets are selected. Black: the observer's frustum on the top plane, and "
                "the rectangle that bounds it. Red: the prism. Packets that meet both are drawn in "
                "bold purple, and their drops alone are there.",
     .printed = "Packet selection."},
    {.id = "creus-4.15",
     .technique = "streaks",
     .settings = OUTSIDE ABOVE "outside=space depth_map=dynamic outside_map=depth packets=world",
     .frame = 30,
     .caption = "A dynamic depth map: the scene seen from above within the culling radius alone, "
                "which lies over the prism, white the highest.",
     .printed = "Dynamic depth map computation."},
    {.id = "creus-4.16a",
     .technique = "streaks",
     .settings = TESTED "overlay=lights camera=first time=night streak_gain=20",
     .frame = 30,
     .parameter = "lights_file",
     .ending = ".json",
     .text = lamp,
     .caption = "Rain under a lamp, whose frustum the lines show: streaks shine within it, in the "
                "patterns of their oscillations.",
     .printed = "Final rain simulation."},
    {.id = "creus-4.16b",
     .technique = "streaks",
     .settings =
         TESTED "overlay=lights camera=first time=night streak_gain=20 environment_light=off",
     .frame = 30,
     .parameter = "lights_file",
     .ending = ".json",
     .text = lamp,
     .caption = "The same without the light of the sky on the rain: no streak is seen outside of "
                "the lamp's light.",
     .printed = "Final rain simulation."},
    {.id = "creus-5.1",
     .technique = "streaks",
     .settings = TESTED "camera=first drops=off splashes=off far_layers=0",
     .frame = 30,
     .caption = "The city of the tests without rain; ours stands in for the thesis's.",
     .printed = "City model used in the tests, by Daz3D."},
    {.id = "creus-5.2a",
     .technique = "streaks",
     .settings = TESTED "camera=first local_height_m=5",
     .frame = 30,
     .caption = "A local space of 5 m, from the first camera: before the sky there is hardly any "
                "rain.",
     .printed = "Renders of the local space size tests, first camera position."},
    {.id = "creus-5.2b",
     .technique = "streaks",
     .settings = TESTED "camera=first local_height_m=20",
     .frame = 30,
     .caption = "A local space of 20 m: it rains before the sky as well.",
     .printed = "Renders of the local space size tests, first camera position."},
    {.id = "creus-5.3a",
     .technique = "streaks",
     .settings = TESTED "camera=second local_height_m=5",
     .frame = 30,
     .caption = "A local space of 5 m, from the second camera: rain far away is a strip along the "
                "horizon.",
     .printed = "Renders of the local space size tests, second camera position."},
    {.id = "creus-5.3b",
     .technique = "streaks",
     .settings = TESTED "camera=second local_height_m=20",
     .frame = 30,
     .caption = "A local space of 20 m: the strip is gone.",
     .printed = "Renders of the local space size tests, second camera position."},
    {.id = "creus-5.4a",
     .technique = "streaks",
     .settings = TESTED "camera=first culling_radius_m=5 cull=exact",
     .frame = 30,
     .caption = "A culling radius of 5 m: splashes end a few metres ahead.",
     .printed = "Renders of the culling radius distance tests."},
    {.id = "creus-5.4b",
     .technique = "streaks",
     .settings = TESTED "camera=first culling_radius_m=20 cull=exact",
     .frame = 30,
     .caption = "A culling radius of 20 m: no end of the rain is noticed.",
     .printed = "Renders of the culling radius distance tests."},
    {.id = "creus-5.5",
     .technique = "streaks",
     .settings = TESTED "camera=second packet_size=50000",
     .frame = 30,
     .caption = "Packets of 50,000 particles. The picture is the same for packets of any size.",
     .printed = "Renders of the packet size tests."},
    {.id = "creus-5.6",
     .technique = "streaks",
     .settings = TESTED "camera=first lights=6",
     .frame = 30,
     .caption = "Six lights by day: the sun, street lamps, a red and a green traffic light. Lamps "
                "themselves are not drawn as lights; what they light shows them.",
     .printed = "Renders of the light amount tests."},
    {.id = "creus-5.7a",
     .technique = "streaks",
     .settings = TESTED "camera=first time=night lights=6",
     .frame = 30,
     .exposure = 1.3,
     .caption = "Six lights by night: three street lamps, a red and a green traffic light, and the "
                "moon. Streaks and splashes have the colours of those that reach them.",
     .printed = "Image using various light sources."},
    {.id = "creus-5.7b",
     .technique = "streaks",
     .settings = TESTED "camera=first time=night lights=6 overlay=lights",
     .frame = 30,
     .exposure = 1.3,
     .caption = "The same with the lights' frusta in their colours, up to 10 m from lamps.",
     .printed = "Image using various light sources."},
    {.id = "creus-5.7c",
     .technique = "streaks",
     .settings = TESTED "camera=first time=night lights=6 geometry=off shadows=off",
     .frame = 30,
     .exposure = 1.3,
     .caption = "The same without the scene and without shadows: the rain alone.",
     .printed = "Image using various light sources."},
    {.id = "creus-5.8a",
     .technique = "streaks",
     .settings =
         TESTED "camera=first shadows=on environment_light=off streak_gain=8 streak_opacity=0",
     .frame = 30,
     .parameter = "lights_file",
     .ending = ".json",
     .text = side_sun,
     .caption = "The sun alone lights the rain: where a tower shades it, streaks before the sky "
                "vanish.",
     .printed = "Example of shadows affecting streak lighting."},
    {.id = "creus-5.8b",
     .technique = "streaks",
     .settings =
         TESTED "camera=first shadows=off environment_light=off streak_gain=8 streak_opacity=0",
     .frame = 30,
     .parameter = "lights_file",
     .ending = ".json",
     .text = side_sun,
     .caption = "The same without shadows: they are seen.",
     .printed = "Example of shadows affecting streak lighting."},
    {.id = NULL},
};
