# What an installation has: programs, their configuration and help, missions and documents. Packages part it
# (packaging/debian).
include(GNUInstallDirs)

install(TARGETS godwitd godwit-trace godwit-sim godwit-drill RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
if(GODWIT_EYES)
  install(TARGETS godwit-eyes RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
endif()

install(FILES config/godwit.json DESTINATION "${CMAKE_INSTALL_FULL_SYSCONFDIR}/godwit")
install(FILES packaging/godwitd.service DESTINATION "lib/systemd/system")
install(FILES packaging/70-godwit.rules DESTINATION "lib/udev/rules.d")
install(FILES packaging/godwitd.logrotate DESTINATION "${CMAKE_INSTALL_FULL_SYSCONFDIR}/logrotate.d" RENAME godwitd)

# The demo finds them beside its folder, as in the tree.
set(shared "${CMAKE_INSTALL_DATADIR}/godwit")
install(FILES config/demo.json config/demo_camera.json config/godwit.schema.json config/openapi.json
              config/operator_port.openapi.json DESTINATION "${shared}/config")
install(DIRECTORY config/schemas DESTINATION "${shared}/config")
install(DIRECTORY missions DESTINATION "${shared}")
install(PROGRAMS scripts/demo DESTINATION "${shared}/scripts")
install(DIRECTORY scripts/demo_lib DESTINATION "${shared}/scripts" FILES_MATCHING PATTERN "*.py")
install(PROGRAMS packaging/godwit-demo DESTINATION "${CMAKE_INSTALL_BINDIR}")

install(FILES README.md CHANGELOG.md DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(DIRECTORY packaging/prometheus packaging/grafana DESTINATION "${CMAKE_INSTALL_DOCDIR}/examples")
