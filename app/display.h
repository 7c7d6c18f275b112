#pragma once

namespace helical {

/// Throws Error(kSystem) when no window could be opened: Qt would abort the process instead of telling us.
void requireDisplay();

/// The same, and the environment is set so that Qt, VTK and Mesa's software renderer suit each other. Before
/// Qt's application object; what the user has set stays.
void prepareDisplay();

}  // namespace helical
