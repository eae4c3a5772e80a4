// Binding points and constants that C++ and GLSL share. A number that differs between the two reads the wrong buffer.
#ifdef __cplusplus
#pragma once
namespace lightsweep::shared {
#define LIGHTSWEEP_CONSTANT inline constexpr int
#else
#define LIGHTSWEEP_CONSTANT const int
#endif

LIGHTSWEEP_CONSTANT kFrameBlock = 0;      // uniform block: FrameData
LIGHTSWEEP_CONSTANT kMaterialBlock = 1;   // uniform block: MaterialData of the draw

LIGHTSWEEP_CONSTANT kLightGridBlock = 2;  // uniform block: LightGridData

LIGHTSWEEP_CONSTANT kBaseColorUnit = 0;  // material textures
LIGHTSWEEP_CONSTANT kMetallicRoughnessUnit = 1;
LIGHTSWEEP_CONSTANT kNormalUnit = 2;
LIGHTSWEEP_CONSTANT kEmissiveUnit = 3;
LIGHTSWEEP_CONSTANT kLightUnit = 4;     // texel buffer: LightData, three RGBA32F texels each
LIGHTSWEEP_CONSTANT kInstanceUnit = 5;  // texel buffer: InstanceData, six RGBA32F texels each
LIGHTSWEEP_CONSTANT kLightCellUnit = 6;   // texel buffer: for each cell of the grid, offset and count (RG32UI)
LIGHTSWEEP_CONSTANT kLightIndexUnit = 7;  // texel buffer: the cells' lights, as indices (R32UI)
LIGHTSWEEP_CONSTANT kTargetUnit = 8;  // targets that a pass reads: kTargetUnit + i, in the order of Pass::reads

// Of passes that rebuild surfaces from triangles and read few targets.
LIGHTSWEEP_CONSTANT kInstanceMeshUnit = 13;  // texel buffer: what each instance draws (RG32UI)
LIGHTSWEEP_CONSTANT kVertexUnit = 14;        // texel buffer: the scene's Vertex, three RGBA32F texels each
LIGHTSWEEP_CONSTANT kIndexUnit = 15;         // texel buffer: R32UI

// The compute shaders that list lights. Draws set their own textures anew; the other units are free below kLightUnit.
LIGHTSWEEP_CONSTANT kLightBoundsUnit = 0;   // texel buffer: LightBounds, three RGBA32F texels each
LIGHTSWEEP_CONSTANT kLightMaskUnit = 1;     // texel buffer: the masks as R32UI, when read
LIGHTSWEEP_CONSTANT kTileDepthUnit = 2;     // RG32F: lowest and highest view distance of a tile's surfaces
LIGHTSWEEP_CONSTANT kLightMaskBuffer = 0;   // storage: the masks when written (shared/light_masks.h)
LIGHTSWEEP_CONSTANT kLightCellBuffer = 1;   // storage: what kLightCellUnit reads
LIGHTSWEEP_CONSTANT kLightIndexBuffer = 2;  // storage: what kLightIndexUnit reads
LIGHTSWEEP_CONSTANT kWantedBuffer = 3;      // storage: how many indices the lists want

LIGHTSWEEP_CONSTANT kPositionAttribute = 0;
LIGHTSWEEP_CONSTANT kNormalAttribute = 1;
LIGHTSWEEP_CONSTANT kTangentAttribute = 2;
LIGHTSWEEP_CONSTANT kTexcoordAttribute = 3;
LIGHTSWEEP_CONSTANT kInstanceAttribute = 4;

LIGHTSWEEP_CONSTANT kLightIndexUniform = 0;  // of shaders that are drawn for each light: which one
LIGHTSWEEP_CONSTANT kLaneBitsUniform = 0;    // lists/light_mask: log2 of the threads that share one light

#ifdef __cplusplus
}  // namespace lightsweep::shared
#endif
#undef LIGHTSWEEP_CONSTANT
