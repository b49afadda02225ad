#pragma once

#include <functional>

namespace offstage::test {

/// Runs `body` in a forked child, so that it may change limits, users and signal handlers, and returns the
/// child's exit status: what `body` returns, 200 if it throws, 128 + the number of the signal that killed it.
/// No destructor outside `body` runs in the child.
int inChild(const std::function<int()>& body);

/// Gives up root's right to write everywhere, for the rest of the (child) process.
void becomeNobody();

} // namespace offstage::test
