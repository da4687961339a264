// A square and a box to touch from C#, without libhl: csharp/HapticClient.cs (docs/csharp.md).
//
//   mcs 13_client.cs ../csharp/HapticClient.cs && mono 13_client.exe [URL [SECONDS]]
//
// URL: hl://HOST[:PORT], default hl://127.0.0.1, an hld or hl touch. With .NET: both files in a console project.
using System;
using System.Diagnostics;
using System.Threading;
using HL;

static class Client {
    const uint Box = 1, BoxName = 8, SquareName = 7;

    static TouchItem Square() {
        var square = new TouchMesh {
            Vertices = new[] { -.05, 0, -.05, .05, 0, -.05, .05, 0, .05, -.05, 0, .05 },
            Triangles = new[] { 0, 3, 2, 0, 2, 1 }
        };
        var rough = new TouchMaterial { StaticFriction = 0.4, DynamicFriction = 0.2 };
        return new TouchItem { Mesh = square, Material = rough, Name = SquareName };
    }

    static TouchMesh UnitBox() {
        var vertices = new double[24];
        for (int corner = 0; corner < 8; ++corner)
            for (int axis = 0; axis < 3; ++axis) vertices[3 * corner + axis] = (corner >> axis & 1) - 0.5;
        return new TouchMesh {
            Vertices = vertices,
            Triangles = new[] { 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5 }
        };
    }

    // A box of 20 mm that goes to and fro over the square: the same object, with another matrix.
    static TouchItem MovingBox(double seconds) {
        double side = 0.02, x = 0.03 * Math.Sin(seconds);
        return new TouchItem {
            Object = Box, Name = BoxName, Matrix = new[] { side, 0, 0, 0, 0, side, 0, 0, 0, 0, side, 0, x, 0.01, 0, 1 }
        };
    }

    static void Print(TouchEvent happened, HapticClient client) {
        if (happened.Kind == TouchEventKind.Touch)
            Console.WriteLine("touching: name {0}, force {1:0.00} N up", happened.Name, client.Newest?.Force_N.Y ?? 0);
        if (happened.Kind == TouchEventKind.Refused || happened.Kind == TouchEventKind.Warning)
            Console.Error.WriteLine("{0}: {1}", happened.Kind, happened.Text);
    }

    static int Main(string[] arguments) {
        double seconds = arguments.Length > 1 ? double.Parse(arguments[1]) : 10;
        var client = new HapticClient(arguments.Length > 0 ? arguments[0] : "hl://127.0.0.1");
        client.Define(Box, new TouchItem { Mesh = UnitBox() });
        var clock = Stopwatch.StartNew();
        while (clock.Elapsed.TotalSeconds < seconds && client.Status != ClientStatus.Closed) {
            client.SetWorld(Square(), MovingBox(clock.Elapsed.TotalSeconds));
            client.Flush();
            while (client.Poll(out TouchEvent happened)) Print(happened, client);
            Thread.Sleep(16);  // what a program with graphics spends on drawing
        }
        if (client.Status == ClientStatus.Closed) {
            Console.Error.WriteLine("13_client: " + client.Reason);
            return 1;
        }
        bool connected = client.Status == ClientStatus.Open;
        client.Dispose();
        client.Ended.Wait();
        if (connected) return 0;
        Console.Error.WriteLine("13_client: no server has answered within {0} s", seconds);
        return 1;
    }
}
