#pragma once

namespace graze::tests {

/// A quad at x = 10 in text FBX. Its morph target "lift" raises corner 0 by 4 as its weight goes from 0 to 1
/// in two seconds. Its target "pull" moves corner 1 and has no keys.
inline constexpr const char* fbx_morph = R"(; FBX 7.4.0 project file
FBXHeaderExtension:  {
 FBXHeaderVersion: 1003
 FBXVersion: 7400
}
GlobalSettings:  {
 Version: 1000
 Properties70:  {
  P: "UpAxis", "int", "Integer", "",1
  P: "UpAxisSign", "int", "Integer", "",1
  P: "FrontAxis", "int", "Integer", "",2
  P: "FrontAxisSign", "int", "Integer", "",1
  P: "CoordAxis", "int", "Integer", "",0
  P: "CoordAxisSign", "int", "Integer", "",1
  P: "UnitScaleFactor", "double", "Number", "",1
  P: "TimeMode", "enum", "", "",11
 }
}
Definitions:  {
 Version: 100
 Count: 1
 ObjectType: "Model" {
  Count: 1
 }
}
Objects:  {
 Geometry: 1000, "Geometry::flapgeo", "Mesh" {
  Vertices: *12 {
   a: 0,0,0,1,0,0,1,1,0,0,1,0
  }
  PolygonVertexIndex: *4 {
   a: 0,1,2,-4
  }
  GeometryVersion: 124
 }
 Geometry: 1001, "Geometry::lift", "Shape" {
  Version: 100
  Indexes: *1 {
   a: 0
  }
  Vertices: *3 {
   a: 0,0,4
  }
  Normals: *3 {
   a: 0,0,0
  }
 }
 Geometry: 1002, "Geometry::pull", "Shape" {
  Version: 100
  Indexes: *1 {
   a: 1
  }
  Vertices: *3 {
   a: 2,0,0
  }
  Normals: *3 {
   a: 0,0,0
  }
 }
 Model: 2000, "Model::flap", "Mesh" {
  Version: 232
  Properties70:  {
   P: "Lcl Translation", "Lcl Translation", "", "A",10,0,0
  }
 }
 Deformer: 3000, "Deformer::shapes", "BlendShape" {
  Version: 100
 }
 Deformer: 3001, "SubDeformer::lift", "BlendShapeChannel" {
  Version: 100
  DeformPercent: 0
  FullWeights: *1 {
   a: 100
  }
 }
 Deformer: 3002, "SubDeformer::pull", "BlendShapeChannel" {
  Version: 100
  DeformPercent: 50
  FullWeights: *1 {
   a: 100
  }
 }
 AnimationStack: 4000, "AnimStack::Take", "" {
  Properties70:  {
   P: "LocalStop", "KTime", "Time", "",92372316000
  }
 }
 AnimationLayer: 4001, "AnimLayer::Base", "" {
 }
 AnimationCurveNode: 4002, "AnimCurveNode::DeformPercent", "" {
  Properties70:  {
   P: "d|DeformPercent", "Number", "", "A",0
  }
 }
 AnimationCurve: 4003, "AnimCurve::", "" {
  Default: 0
  KeyVer: 4008
  KeyTime: *2 {
   a: 0,92372316000
  }
  KeyValueFloat: *2 {
   a: 0,100
  }
 }
}
Connections:  {
 C: "OO",2000,0
 C: "OO",1000,2000
 C: "OO",3000,1000
 C: "OO",3001,3000
 C: "OO",1001,3001
 C: "OO",3002,3000
 C: "OO",1002,3002
 C: "OO",4001,4000
 C: "OO",4002,4001
 C: "OP",4002,3001, "DeformPercent"
 C: "OP",4003,4002, "d|DeformPercent"
}
)";

}  // namespace graze::tests
