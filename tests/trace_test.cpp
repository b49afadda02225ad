#include "src/scene/scene.h"
#include "src/scene/trace.h"
#include "tests/support/scene_text.h"

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace offstage {
namespace {

World worldOf(const std::string& bodies) {
  return World(test::sceneOf(bodies).world);
}

std::string traceOf(const World& world, TraceFormat format) {
  std::ostringstream out;
  TraceWriter writer(out, format, world.setup().groups);
  writer.write(world);
  return out.str();
}

TEST(Trace, CsvHasAHeaderAndARowForEachBody) {
  const World world =
      worldOf("[[body]]\ncenter = [1, 2.5]\nradius = 3\nvelocity = [-4, 0.1]\n"
              "[[body]]\ngroup = \"boxes\"\nshape = \"rectangle\"\nposition = [10, 20]\nsize = [5, 6]\n");
  EXPECT_EQ(traceOf(world, TraceFormat::Csv), "frame,id,time,x,y,vx,vy,radius,group\n"
                                              "0,0,0,1,2.5,-4,0.1,3,bodies\n"
                                              "0,1,0,10,20,0,0,0,boxes\n");
}

TEST(Trace, JsonLinesHaveTheSameKeys) {
  const World world = worldOf("[[body]]\ncenter = [1, 2.5]\nradius = 3\n");
  EXPECT_EQ(traceOf(world, TraceFormat::JsonLines), "{\"frame\":0,\"id\":0,\"time\":0,\"x\":1,\"y\":2.5,"
                                                    "\"vx\":0,\"vy\":0,\"radius\":3,\"group\":\"bodies\"}\n");
}

TEST(Trace, DoublesReadBackToTheSameBits) {
  Scene scene = test::sceneOf("[[body]]\ncenter = [0, 0]\nradius = 0\n");
  for (const double value : {0.1, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, -0.0, 1e22, 16.666667}) {
    scene.world.bodies[0].position.x() = value;
    const std::string text = traceOf(World(scene.world), TraceFormat::Csv);
    const std::string row = text.substr(text.find('\n') + 1);
    const double back = std::strtod(row.c_str() + row.find(',', row.find(',', 2) + 1) + 1, nullptr);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(value)) << row;
  }
}

TEST(Trace, WhatIsNoNumberIsNullInJsonAndWrittenOutInCsv) {
  Scene scene = test::sceneOf("[[body]]\ncenter = [0, 0]\nradius = 0\n");
  scene.world.bodies[0].position = {std::numeric_limits<double>::quiet_NaN(),
                                    -std::numeric_limits<double>::infinity()};
  // As x86 makes it of 0/0; ARM makes the other.
  scene.world.bodies[0].velocity.x() = -std::numeric_limits<double>::quiet_NaN();
  const World world(scene.world);
  EXPECT_NE(traceOf(world, TraceFormat::JsonLines).find("\"x\":null,\"y\":null,"), std::string::npos);
  EXPECT_NE(traceOf(world, TraceFormat::Csv).find("\n0,0,0,nan,-inf,nan,"), std::string::npos);
}

TEST(Trace, GroupNamesAreQuotedWhereTheFormatNeedsIt) {
  const World world = worldOf("[[body]]\ngroup = \"a,\\\"b\\\"\\n\"\ncenter = [0, 0]\nradius = 0\n");
  EXPECT_TRUE(traceOf(world, TraceFormat::Csv).ends_with(",0,\"a,\"\"b\"\"\n\"\n"))
      << traceOf(world, TraceFormat::Csv);
  EXPECT_TRUE(traceOf(world, TraceFormat::JsonLines).ends_with("\"group\":\"a,\\\"b\\\"\\u000a\"}\n"))
      << traceOf(world, TraceFormat::JsonLines);
}

TEST(Trace, AnEmptyWorldHasNoRows) {
  EXPECT_EQ(traceOf(worldOf(""), TraceFormat::Csv), "frame,id,time,x,y,vx,vy,radius,group\n");
  EXPECT_EQ(traceOf(worldOf(""), TraceFormat::JsonLines), "");
}

TEST(Trace, EventsOfTheLastStep) {
  const Scene scene = test::sceneOf("[walls]\nbottom = 0.5\n[clock]\nfps = 4\n[world]\ngravity = [0, 0]\n"
                                    "[[body]]\ncenter = [100, 450]\nradius = 20\nvelocity = [0, 60]\n");
  World world(scene.world);
  std::ostringstream csv;
  std::ostringstream json;
  EventWriter csvWriter(csv, TraceFormat::Csv);
  EventWriter jsonWriter(json, TraceFormat::JsonLines);
  csvWriter.write(world);
  world.step(scene.clock.tick(1));
  csvWriter.write(world);
  jsonWriter.write(world);
  EXPECT_EQ(csv.str(), "frame,event,id1,id2,time,p,q\n1,bottom,0,-1,0.25,465,60\n");
  EXPECT_EQ(json.str(),
            "{\"frame\":1,\"event\":\"bottom\",\"id1\":0,\"id2\":-1,\"time\":0.25,\"p\":465,\"q\":60}\n");
}

} // namespace
} // namespace offstage
