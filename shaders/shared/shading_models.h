// The shading models' numbers, as scene/scene.h's ShadingModel has them and the G-buffer stores them (2 bits).
#define MODEL_GGX 0u
#define MODEL_BLINN_PHONG 1u
#define MODEL_LAMBERT 2u
