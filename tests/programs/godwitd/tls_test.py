#!/usr/bin/python3
"""The operator's port beyond the computer itself, as other computers and strangers find it: tls_test.py PATH_TO_GODWITD."""
import hashlib
import http.client
import json
import pathlib
import re
import shutil
import socket
import ssl
import stat
import subprocess
import time
import unittest

from operator_test import FAILED, MISSION, PASSWORD, PATIENCE_S, PROGRAM, USAGE, World

PLACES = 24  # of one address: operator_port's settings::max_clients_an_address
PATTERN = re.compile(r"what there is to see: (https?)://([^/]+):(\d+)/\s")


def address_of_this_computer():
    """One that is not loopback, without sending anything; none: there is no network."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asked:
        try:
            asked.connect(("192.0.2.1", 9))
            return asked.getsockname()[0]
        except OSError:
            return None


class Tls(World):
    def setUp(self):
        super().setUp()
        self.operator("add", "anna", "--role", "operator", given=PASSWORD + "\n")
        self.token = self.operator("token", "anna").stdout.strip()

    def words(self, *more):
        return ["--mission", MISSION, "--vehicle", "udpin://127.0.0.1:0", "--journal", str(self.folder / "godwit.db"),
                "--trace", str(self.folder / "trace"), "--accounts", str(self.accounts), *more]

    def configuration(self, **operator):
        path = self.folder / "godwit.json"
        path.write_text(json.dumps({"operator": operator}), encoding="utf-8")
        return str(path)

    def begin(self, *more, listen="0.0.0.0:0"):
        started = subprocess.Popen([PROGRAM, *self.words("--operator-listen", listen, *more)], stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True)
        self.addCleanup(self.end, started)
        self.said = ""
        for line in started.stdout:
            self.said += line
            if "fingerprint (SHA-256) is" in line or "goes on without it" in line:
                break
        if found := PATTERN.search(self.said):
            self.port = int(found.group(3))
            self.fingerprint = re.search(r"is ((?:[0-9A-F]{2}:){31}[0-9A-F]{2})", self.said).group(1)
        return started

    def end(self, started):
        started.terminate()
        started.communicate(timeout=PATIENCE_S)

    def trusting(self):
        return ssl.create_default_context(cafile=str(self.certificate()))

    def certificate(self):
        both = (self.folder / "godwit.tls").read_text(encoding="ascii")
        path = self.folder / "certificate.pem"
        path.write_text(both[both.index("-----BEGIN CERTIFICATE"):], encoding="ascii")
        return path

    def ask(self, method, target, body=None, host="127.0.0.1", **headers):
        client = http.client.HTTPSConnection(host, self.port, timeout=PATIENCE_S, context=self.trusting())
        try:
            client.request(method, target, None if body is None else json.dumps(body),
                           {"Content-Type": "application/json", **headers})
            answer = client.getresponse()
            return answer.status, answer.read().decode(), answer.headers
        finally:
            client.close()

    def ctl_status(self):
        return self.run_it("ctl", "status", "--journal", str(self.folder / "godwit.db")).stdout

    def test_it_makes_its_certificate_once_and_shows_its_fingerprint(self):
        started = self.begin()
        self.assertIn("a new certificate was made", self.said)
        self.assertEqual(stat.S_IMODE((self.folder / "godwit.tls").stat().st_mode), 0o600)
        seen = ssl.PEM_cert_to_DER_cert(self.certificate().read_text(encoding="ascii"))
        self.assertEqual(self.fingerprint.replace(":", "").lower(), hashlib.sha256(seen).hexdigest())
        self.assertIn(f"fingerprint {self.fingerprint}", self.ctl_status())
        self.assertEqual(self.ask("GET", "/healthz", host="localhost")[0] in (200, 503), True)
        first = self.fingerprint
        self.end(started)
        self.begin()
        self.assertNotIn("a new certificate", self.said)
        self.assertEqual(self.fingerprint, first)

    def test_a_session_over_tls_has_a_cookie_for_tls_alone(self):
        self.begin()
        status, body, headers = self.ask("POST", "/api/v1/session", {"name": "anna", "password": PASSWORD})
        self.assertEqual(status, 201, body)
        self.assertRegex(headers["Set-Cookie"], r"; HttpOnly; SameSite=Strict; Secure$")
        cookie = headers["Set-Cookie"].split(";")[0]
        self.assertEqual(self.ask("POST", "/api/v1/control", {"act": "take"}, Cookie=cookie)[0], 200)

    def test_from_another_address_looking_needs_a_session_or_a_token(self):
        other = address_of_this_computer()
        if other is None:
            self.skipTest("this computer has no other address")
        self.begin()
        for target in ("/status", "/metrics", "/healthz", "/api/v1/stream"):
            self.assertEqual(self.ask("GET", target, host=other)[0], 401, target)
        self.assertEqual(self.ask("GET", "/status", host=other, Authorization="Bearer " + self.token)[0], 200)
        self.assertEqual(self.ask("GET", "/status", host=other, Authorization="Bearer " + "x" * 43)[0], 401)
        upgrade = {"Connection": "Upgrade", "Upgrade": "websocket", "Sec-WebSocket-Version": "13",
                   "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ=="}
        line = self.trusting().wrap_socket(socket.create_connection((other, self.port), timeout=PATIENCE_S),
                                           server_hostname=other)
        self.addCleanup(line.close)
        said = {"Host": other, "Authorization": "Bearer " + self.token, **upgrade}
        line.sendall(("GET /api/v1/stream?topics=log HTTP/1.1\r\n" +
                      "".join(f"{name}: {text}\r\n" for name, text in said.items()) + "\r\n").encode())
        stream = line.makefile("rb")
        self.assertEqual(stream.readline(), b"HTTP/1.1 101 Switching Protocols\r\n")
        while stream.readline() != b"\r\n":
            pass
        self.assertIn(b'"session"', stream.read(2 + stream.read(2)[1])[:200])

    def test_who_speaks_no_tls_is_told_so_and_who_says_nothing_is_closed(self):
        self.begin()
        client = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE_S)
        client.request("GET", "/status")
        answer = client.getresponse()
        self.assertEqual(answer.status, 400)
        self.assertIn(b"ask with https://", answer.read())
        for garbage in (b"", b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", bytes(range(256)) * 40):
            line = socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE_S)
            line.sendall(garbage)
            began = time.monotonic()
            try:
                while line.recv(4096):
                    pass
            except ConnectionResetError:
                pass
            self.assertLess(time.monotonic() - began, 8)
            line.close()
        figures = self.ask("GET", "/metrics")[1]
        self.assertRegex(figures, r"godwit_operator_port_handshakes_failed_total [23]\n")
        self.assertRegex(figures, r"godwit_operator_port_handshake_timeouts_total [12]\n")
        self.assertRegex(figures, r"godwit_operator_port_handshakes_total [1-9]")

    def test_an_address_has_so_many_places_also_for_handshakes_that_do_not_go_on(self):
        other = address_of_this_computer()
        if other is None:
            self.skipTest("this computer has no other address")
        self.begin()
        idle = [socket.create_connection(("127.0.0.1", self.port)) for _ in range(PLACES)]
        for each in idle:
            self.addCleanup(each.close)
        too_many = socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE_S)
        self.addCleanup(too_many.close)
        self.assertEqual(too_many.recv(1), b"")
        self.assertEqual(self.ask("GET", "/status", host=other, Authorization="Bearer " + self.token)[0], 200)

    def test_a_client_of_openssl_sees_1_2_and_1_3_and_nothing_older(self):
        program = shutil.which("openssl")
        if program is None:
            self.skipTest("there is no openssl")
        self.begin()
        for version, works in (("-tls1_3", True), ("-tls1_2", True), ("-tls1_1", False)):
            done = subprocess.run([program, "s_client", "-connect", f"127.0.0.1:{self.port}", "-verify_return_error",
                                   "-CAfile", str(self.certificate()), "-cipher", "ALL:@SECLEVEL=0", version], input="",
                                  capture_output=True, text=True, timeout=PATIENCE_S)
            self.assertEqual("Verify return code: 0 (ok)" in done.stdout and done.returncode == 0, works,
                             version + done.stdout + done.stderr)

    def test_beyond_this_computer_it_does_not_start_without_an_account(self):
        self.accounts.unlink()
        for place in ("0.0.0.0:0", "[::]:0"):
            ended = self.run_it(*self.words("--operator-listen", place))
            self.assertEqual(ended.returncode, FAILED, ended.stdout + ended.stderr)
            said = ended.stdout + ended.stderr
            self.assertIn("--operator-listen (GODWIT_OPERATOR_LISTEN, operator.listen)", said)
            self.assertIn("godwitd operator add", said)
            self.assertIn("127.0.0.1", said)
        ended = self.run_it(*self.words("--operator-listen", "0.0.0.0:0", "--ground-run"))
        self.assertEqual(ended.returncode, USAGE)

    def test_files_that_can_not_be_used_are_named_and_it_goes_on_without_the_port(self):
        self.begin()
        (self.folder / "key.pem").write_text("no key", encoding="ascii")
        (self.folder / "key.pem").chmod(0o600)
        for certificate, key, named in (("none.pem", "key.pem", "none.pem"),
                                        ("certificate.pem", "key.pem", "key.pem"),
                                        ("certificate.pem", "certificate.pem", "chmod 600")):
            self.certificate().chmod(0o644)
            world = Tls("ask")
            world.folder, world.accounts, world.addCleanup = self.folder / "other", self.accounts, self.addCleanup
            world.folder.mkdir(exist_ok=True)
            settings = world.configuration(certificate=str(self.folder / certificate), key=str(self.folder / key))
            started = world.begin("--config", settings)
            self.assertIn(named, world.said)
            self.assertIn("goes on without it", world.said)
            self.assertIsNone(started.poll())
            self.assertIn("operator_port", world.ctl_status())
            world.end(started)

    def test_with_its_setting_this_computer_itself_speaks_tls_too(self):
        self.begin("--config", self.configuration(tls=True), listen="127.0.0.1:0")
        self.assertEqual(PATTERN.search(self.said).group(1), "https")
        self.assertEqual(self.ask("GET", "/status")[0], 200)


if __name__ == "__main__":
    unittest.main()
