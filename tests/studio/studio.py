"""`ripstop studio` as a process, and requests to it."""
import http.client
import json
import pathlib
import signal
import subprocess
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


class Studio:
    def __init__(self, program, folder, *arguments):
        self.process = subprocess.Popen([program, "studio", str(folder), "--no-browser", *arguments], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.address = self.process.stdout.readline().strip()
        if not self.address:
            self.process.stdout.close()
            raise RuntimeError(f"no address, exit code {self.process.wait()}")
        parts = urllib.parse.urlsplit(self.address)
        self.port, self.token = parts.port, urllib.parse.parse_qs(parts.query)["token"][0]

    def request(self, method, path, body=None, headers=None, without=()):
        """Status, headers and bytes; `headers` replace those of the page, `without` names some to leave out."""
        all_headers = {"Host": f"127.0.0.1:{self.port}", "X-Ripstop-Token": self.token, **({"Content-Type": "application/json"} if method == "POST" else {}), **(headers or {})}
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        connection.putrequest(method, path, skip_host=True)
        data = body if isinstance(body, bytes) else None if body is None else json.dumps(body).encode()
        if data is not None and "Content-Length" not in all_headers:
            all_headers["Content-Length"] = str(len(data))
        for name, value in all_headers.items():
            if name not in without:
                connection.putheader(name, value)
        connection.endheaders(data)
        answer = connection.getresponse()
        result = answer.status, answer.headers, answer.read()
        connection.close()
        return result

    def get(self, path, **parameters):
        status, _, body = self.request("GET", f"{path}?{urllib.parse.urlencode(parameters)}")
        return status, json.loads(body)

    def post(self, path, **body):
        status, _, answer = self.request("POST", path, body)
        return status, json.loads(answer)

    def end(self, number=signal.SIGINT):
        self.process.send_signal(number)
        code = self.process.wait(20)
        self.process.stdout.close()
        return code
