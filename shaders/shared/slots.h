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

LIGHTSWEEP_CONSTANT kPositionAttribute = 0;
LIGHTSWEEP_CONSTANT kNormalAttribute = 1;
LIGHTSWEEP_CONSTANT kTangentAttribute = 2;
LIGHTSWEEP_CONSTANT kTexcoordAttribute = 3;
LIGHTSWEEP_CONSTANT kInstanceAttribute = 4;

LIGHTSWEEP_CONSTANT kLightIndexUniform = 0;  // deferred_volumes: the light of this draw

#ifdef __cplusplus
}  // namespace lightsweep::shared
#endif
#undef LIGHTSWEEP_CONSTANT
